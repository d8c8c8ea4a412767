// Descriptions of the arrays of a field, and all that follows from them for any representation: lengths, initial values, memory,
// division of volumes, and what is summed over processes. A representation lists its arrays once (Model::kArrays, in the order of
// files); files, back ends and processes walk over the list.
#pragma once

#include <algorithm>
#include <concepts>
#include <span>
#include <type_traits>
#include <variant>

#include "core/base/host_array.h"
#include "core/fields/field_shape.h"
#include "core/kernel/guiding/mixture.h"

namespace pl {

/// The owners of an array's values. `count`: the number of values for each radiance volume by the shape of the field,
/// or, if volumes own none, the number of all values by the host's storage of the field.
template <class Count>
struct ArrayOwner {
    const char* name;  ///< of one, in messages
    Count count;
};
template <class Count>
ArrayOwner(const char*, Count) -> ArrayOwner<Count>;

inline constexpr ArrayOwner kOfVolume{"volume", [](const FieldShape&) -> std::size_t { return 1; }};
inline constexpr ArrayOwner kOfCluster{"volume",
                                       [](const FieldShape& shape) -> std::size_t { return shape.light_clusters; }};

/// Values of the new volume when one is split in two.
enum class OnSplit {
    Copy,    ///< the values of its parent
    Halve,   ///< both get half of the parent's
    Divide,  ///< counts: each of the two gets half, odd ones alternate by cell
    Clear,   ///< 0; the parent keeps its values
};

/// Values that files may hold.
enum class ValidRange {
    Any,           ///< all, or checked together with other arrays
    Amount,        ///< finite, at least 0
    Finite,        ///< finite
    NotNegative,   ///< at least 0
    BsdfFraction,  ///< kMinBsdfFraction to kMaxBsdfFraction
    Cumulative,    ///< each row rises from at least 0 to exactly 1
    Choice,        ///< each row is Cumulative, or all 0
};

/// Description of one array of a field.
template <class Owner, class Initial, class Get>
struct ArraySpec {
    const char* name;    ///< plural, in messages
    const char* single;  ///< of one value, in messages
    Owner owner;
    OnSplit on_split;  ///< of a radiance volume; of no effect if volumes own no values
    ValidRange valid;
    Initial initial;  ///< value i of a volume, or of the array, without training samples: initial(shape, i)
    Get get;          ///< the array of any memory or view that has it
};
template <class Owner, class Initial, class Get>
ArraySpec(const char*, const char*, Owner, OnSplit, ValidRange, Initial, Get) -> ArraySpec<Owner, Initial, Get>;

/// Descriptions of the arrays of a model, each of a type of its own. A std::tuple of so many takes seconds to compile.
template <class... Specs>
struct SpecList : Specs... {};
template <class... Specs>
SpecList(Specs...) -> SpecList<Specs...>;

template <class... A, class... B>
constexpr SpecList<A..., B...> operator+(const SpecList<A...>& a, const SpecList<B...>& b) {
    return {static_cast<const A&>(a)..., static_cast<const B&>(b)...};
}

template <class... Specs, class Fn>
constexpr void for_each_spec(const SpecList<Specs...>& all, Fn&& fn) {
    (fn(static_cast<const Specs&>(all)), ...);
}

inline constexpr auto kZero = [](const FieldShape&, std::size_t) { return 0; };

// clang-format off
/// The arrays of MixtureSums, one value for each owner.
template <class Owner>
constexpr auto mixture_arrays(const Owner& owner) {
    using enum OnSplit;
    using enum ValidRange;
    constexpr auto kFraction = [](const FieldShape&, std::size_t) { return kInitialBsdfFraction; };
    return SpecList{
        ArraySpec{"slopes of the mixture", "slope of the mixture", owner, Clear, Any, kZero, [](auto& t) -> auto& { return t.pending_slope; }},
        ArraySpec{"curvatures of the mixture", "curvature of the mixture", owner, Clear, NotNegative, kZero, [](auto& t) -> auto& { return t.pending_curvature; }},
        ArraySpec{"targets of the mixture", "target of the mixture", owner, Halve, Finite, kZero, [](auto& t) -> auto& { return t.mixture_target; }},
        ArraySpec{"weights of the mixture", "weight of the mixture", owner, Halve, Amount, kZero, [](auto& t) -> auto& { return t.mixture_weight; }},
        ArraySpec{"BSDF shares", "BSDF share", owner, Copy, BsdfFraction, kFraction, [](auto& t) -> auto& { return t.bsdf_fraction; }},
    };
}

/// The arrays of VolumeIrradiance.
inline constexpr SpecList kIrradianceArrays{
    ArraySpec{"mean radiance", "mean radiance", kOfVolume, OnSplit::Copy, ValidRange::Amount, kZero, [](auto& t) -> auto& { return t.mean_radiance; }},
    ArraySpec{"samples", "samples", kOfVolume, OnSplit::Divide, ValidRange::Any, kZero, [](auto& t) -> auto& { return t.samples; }},
    ArraySpec{"sums of values", "sum of values", kOfVolume, OnSplit::Clear, ValidRange::NotNegative, kZero, [](auto& t) -> auto& { return t.pending_value; }},
    ArraySpec{"sums of weights", "sum of weights", kOfVolume, OnSplit::Clear, ValidRange::NotNegative, kZero, [](auto& t) -> auto& { return t.pending_weight; }},
    ArraySpec{"new samples", "new samples", kOfVolume, OnSplit::Clear, ValidRange::Any, kZero, [](auto& t) -> auto& { return t.pending_samples; }},
    ArraySpec{"changes", "change", kOfVolume, OnSplit::Copy, ValidRange::Amount, kZero, [](auto& t) -> auto& { return t.change; }},
};

/// The arrays of LightSampleSums.
inline constexpr SpecList kLightArrays{
    ArraySpec{"sums of direct light", "sum of direct light", kOfVolume, OnSplit::Clear, ValidRange::NotNegative, kZero, [](auto& t) -> auto& { return t.pending_direct; }},
    ArraySpec{"counts of light samples", "count of light samples", kOfVolume, OnSplit::Clear, ValidRange::Any, kZero, [](auto& t) -> auto& { return t.pending_direct_count; }},
    ArraySpec{"direct light", "direct light", kOfVolume, OnSplit::Copy, ValidRange::Amount, kZero, [](auto& t) -> auto& { return t.direct; }},
    ArraySpec{"light samples", "light samples", kOfVolume, OnSplit::Divide, ValidRange::Any, kZero, [](auto& t) -> auto& { return t.direct_count; }},
    ArraySpec{"sums of light by clusters", "sum of light by a cluster", kOfCluster, OnSplit::Clear, ValidRange::NotNegative, kZero, [](auto& t) -> auto& { return t.pending_cluster; }},
    ArraySpec{"light by clusters", "light by a cluster", kOfCluster, OnSplit::Copy, ValidRange::Amount, kZero, [](auto& t) -> auto& { return t.cluster_light; }},
    ArraySpec{"choices of lights", "choice of lights", kOfCluster, OnSplit::Copy, ValidRange::Choice, kZero, [](auto& t) -> auto& { return t.light_cdf; }},
};
// clang-format on

/// The model of a storage of arrays, in memory of any kind: a representation declares model_of(const its storage&).
template <class Storage>
using ModelOf = decltype(model_of(std::declval<const Storage&>()));
template <class Storage>
concept FieldStorage = requires {
    ModelOf<Storage>::kArrays;
};

/// Calls fn(spec) for every array of a storage.
template <FieldStorage Storage, class Fn>
constexpr void for_each_array_of(Fn&& fn) {
    for_each_spec(ModelOf<Storage>::kArrays, fn);
}

/// Calls fn(spec, array) for every array of `arrays`, which may be const.
template <FieldStorage Storage, class Fn>
void for_each_array(Storage& arrays, Fn&& fn) {
    for_each_array_of<Storage>([&](const auto& spec) { fn(spec, spec.get(arrays)); });
}

/// Calls fn(array of `from`, array of `to`) for every array; `to` is const if fn only reads it.
template <FieldStorage From, class To, class Fn>
void zip(const From& from, To& to, Fn&& fn) {
    for_each_array_of<From>([&](const auto& spec) { fn(spec.get(from), spec.get(to)); });
}

/// Lets a view read the arrays of a storage.
template <class List, class View, class Storage>
void set_arrays(const List& list, View& view, Storage& arrays) {
    for_each_spec(list, [&](const auto& spec) { spec.get(view) = view_of(spec.get(arrays)); });
}

/// Whether each radiance volume owns values of an array.
template <class Spec>
inline constexpr bool kIsByVolume = std::is_invocable_v<decltype(Spec::owner.count), const FieldShape&>;

/// Number of values of an array for this number of volumes, given the other arrays of a storage on the host.
template <class Spec, FieldStorage Storage>
std::size_t length_of(const Spec& spec, const FieldShape& shape, const Storage& arrays, std::size_t volumes) {
    if constexpr (kIsByVolume<Spec>)
        return volumes * spec.owner.count(shape);
    else
        return spec.owner.count(arrays);
}

/// Sets the values [first, first + count) of an array, which begin at value `index` of their owner, to the values
/// without training samples.
template <class Spec, class Array>
void reset_values(const Spec& spec, const FieldShape& shape, Array& values, std::size_t first, std::size_t count,
                  std::size_t index = 0) {
    using Value = typename Array::value_type;
    for (std::size_t i = 0; i < count; ++i) values[first + i] = static_cast<Value>(spec.initial(shape, index + i));
}

/// A field without training samples.
template <FieldStorage Storage>
Storage make_arrays(const FieldShape& shape, std::size_t volumes) {
    Storage arrays;
    for_each_array(arrays, [&](const auto& spec, auto& values) {
        using Spec = std::remove_cvref_t<decltype(spec)>;
        values.resize(length_of(spec, shape, arrays, volumes));
        const std::size_t owners = kIsByVolume<Spec> ? volumes : 1;
        const std::size_t each = owners > 0 ? values.size() / owners : 0;
        for (std::size_t i = 0; i < owners; ++i) reset_values(spec, shape, values, i * each, each);
    });
    return arrays;
}

/// Sets the values that a volume owns to the initial values of make_arrays().
template <FieldStorage Storage>
void reset_volume(const FieldShape& shape, Storage& arrays, std::size_t volume) {
    for_each_array(arrays, [&](const auto& spec, auto& values) {
        if constexpr (kIsByVolume<std::remove_cvref_t<decltype(spec)>>) {
            const std::size_t each = spec.owner.count(shape);
            reset_values(spec, shape, values, volume * each, each);
        }
    });
}

/// Whether all arrays have the length that follows from the shape, the number of volumes, and each other.
template <FieldStorage Storage>
bool fits(const FieldShape& shape, const Storage& arrays, std::size_t volumes) {
    bool all = true;
    for_each_array(arrays, [&](const auto& spec, const auto& values) {
        all = all && values.size() == length_of(spec, shape, arrays, volumes);
    });
    return all;
}

template <FieldStorage Storage>
std::size_t volume_count(const Storage& arrays) {
    return arrays.mean_radiance.size();
}

template <FieldStorage Storage>
std::size_t field_bytes(const Storage& arrays) {
    std::size_t bytes = 0;
    for_each_array(arrays, [&](const auto&, const auto& values) { bytes += values.size() * sizeof *values.data(); });
    return bytes;
}

/// Bytes that each radiance volume owns.
template <FieldStorage Storage>
std::size_t bytes_by_volume(const FieldShape& shape) {
    std::size_t bytes = 0;
    for_each_array_of<Storage>([&](const auto& spec) {
        using Values = std::remove_cvref_t<decltype(spec.get(std::declval<Storage&>()))>;
        if constexpr (kIsByVolume<std::remove_cvref_t<decltype(spec)>>)
            bytes += spec.owner.count(shape) * sizeof(typename Values::value_type);
    });
    return bytes;
}

/// Divides a value between a volume and its copy. Odd counts go to the child in every second cell of a checkerboard,
/// so that cells with one training sample each leave both volumes with samples all over their hemispheres.
template <class T>
void split_value(OnSplit rule, T& parent, T& child, bool odd_to_child) {
    if (rule == OnSplit::Clear) child = T{};
    if (rule == OnSplit::Copy) child = parent;
    if (rule == OnSplit::Halve) parent = child = static_cast<T>(static_cast<float>(parent) * 0.5f);
    if constexpr (std::same_as<T, std::uint32_t>) {
        if (rule != OnSplit::Divide) return;
        child = parent / 2 + (odd_to_child ? parent % 2 : 0);
        parent -= child;
    }
}

/// A field of a refined placement: each new volume, numbered after the others, begins with what its parent has learned. Counts of
/// training samples are divided evenly between the two, cell by cell, since the child serves about half of the points; none is lost
/// or counted twice. Pending sums stay with the parent, and arrays that no volume owns stay as they are.
template <FieldStorage Storage>
Storage split_arrays(const FieldShape& shape, Storage arrays, std::span<const std::uint32_t> parents) {
    const std::size_t volumes = volume_count(arrays);
    const auto side = static_cast<std::size_t>(shape.cells.side);
    for_each_array(arrays, [&](const auto& spec, auto& values) {
        if constexpr (kIsByVolume<std::remove_cvref_t<decltype(spec)>>) {
            const std::size_t each = spec.owner.count(shape);
            values.resize((volumes + parents.size()) * each);
            for (std::size_t i = 0; i < parents.size(); ++i)
                for (std::size_t k = 0; k < each; ++k)
                    split_value(spec.on_split, values[parents[i] * each + k], values[(volumes + i) * each + k],
                                (k / side + k % side) % 2 != 0);
        }
    });
    return arrays;
}

/// One array of pending sums: integers, which are added up over processes.
using PendingSums = std::variant<std::span<std::int64_t>, std::span<std::uint32_t>>;

/// Calls fn(array) for every array of pending sums, in the order of files.
template <FieldStorage Storage, class Fn>
void for_each_pending_array(Storage& arrays, Fn&& fn) {
    for_each_array(arrays, [&](const auto& spec, auto& values) {
        using Value = std::remove_cvref_t<decltype(*values.data())>;
        if constexpr (std::same_as<Value, std::int64_t> || std::same_as<Value, std::uint32_t>)
            if (spec.on_split == OnSplit::Clear) fn(values);
    });
}

}  // namespace pl
