// The pending sums of a field as plain arrays of integers: to be added up over processes.
#pragma once

#include <concepts>
#include <span>
#include <variant>

#include "core/fields/sd_tree_model.h"

namespace pl {

/// One array of pending sums.
using PendingSums = std::variant<std::span<std::int64_t>, std::span<std::uint32_t>>;

template <class T>
concept PendingValue = std::same_as<T, std::int64_t> || std::same_as<T, std::uint32_t>;

/// Calls fn(array) for every array of pending sums, in the order of files: the arrays that a split clears.
template <template <class> class Array, class Fn>
void for_each_pending_array(TableStorage<Array>& tables, Fn&& fn) {
    for_each_table_array([&](const auto& spec) {
        using Value = std::remove_cvref_t<decltype(spec.get(std::declval<HostTables&>())[0])>;
        if constexpr (PendingValue<Value>)
            if (spec.on_split == OnSplit::Clear) fn(spec.get(tables));
    });
}
template <template <class> class Array, class Fn>
void for_each_pending_array(SdTreeStorage<Array>& tree, Fn&& fn) {
    for_each_sd_tree_array([&](const auto& spec) {
        using Value = std::remove_cvref_t<decltype(spec.get(std::declval<HostSdTree&>())[0])>;
        if constexpr (PendingValue<Value>)
            if (spec.part == SdTreePart::Pending) fn(spec.get(tree));
    });
}

}  // namespace pl
