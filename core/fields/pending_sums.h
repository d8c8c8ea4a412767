// The pending sums of a field as plain arrays of integers: to be added up over processes.
#pragma once

#include <concepts>
#include <span>
#include <variant>

#include "core/fields/lobe_model.h"
#include "core/fields/sd_tree_model.h"

namespace pl {

/// One array of pending sums.
using PendingSums = std::variant<std::span<std::int64_t>, std::span<std::uint32_t>>;

template <class T>
concept PendingValue = std::same_as<T, std::int64_t> || std::same_as<T, std::uint32_t>;

/// A function of the description of an array that calls fn(array of `field`) if the array holds pending sums, which a split clears.
template <class Field, class Fn>
auto of_pending_array(Field& field, Fn& fn) {
    return [&](const auto& spec) {
        using Value = std::remove_cvref_t<decltype(*spec.get(field).data())>;
        if constexpr (PendingValue<Value>)
            if (spec.on_split == OnSplit::Clear) fn(spec.get(field));
    };
}

/// Calls fn(array) for every array of pending sums, in the order of files.
template <template <class> class Array, class Fn>
void for_each_pending_array(TableStorage<Array>& tables, Fn&& fn) {
    for_each_table_array(of_pending_array(tables, fn));
}
template <template <class> class Array, class Fn>
void for_each_pending_array(SdTreeStorage<Array>& tree, Fn&& fn) {
    for_each_sd_tree_array(of_pending_array(tree, fn));
}
template <template <class> class Array, class Fn>
void for_each_pending_array(LobeStorage<Array>& lobes, Fn&& fn) {
    for_each_lobe_array(of_pending_array(lobes, fn));
}

}  // namespace pl
