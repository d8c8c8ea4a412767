// The layout of every struct that crosses to the device, as one sequence of numbers, found without lists of members: the
// parameters of all kernels and the elements of all arrays, and what they are made of. Compiled by the C++ compiler
// (print_layout.cpp) and for the device (device_layout.cu).
#pragma once

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>
#include <utility>

#include "cuda/kernels/kernels.h"

namespace pl::layout {

/// Converts to whatever a member is.
struct Anything {
    template <class T>
    PL_HD constexpr operator T&() const;
};
template <std::size_t>
using AnythingAt = Anything;

template <class T, std::size_t... I>
constexpr bool takes(std::index_sequence<I...>) {
    return requires { T{AnythingAt<I>{}...}; };
}

/// Number of members of an aggregate: the most initializers that it takes.
template <class T, std::size_t kMost = 40>
constexpr std::size_t member_count() {
    if constexpr (kMost == 0 || takes<T>(std::make_index_sequence<kMost>{}))
        return kMost;
    else
        return member_count<T, kMost - 1>();
}

/// References to the members of an aggregate without bases and without C arrays.
template <class T>
PL_HD constexpr auto members(T& value) {
    constexpr std::size_t kCount = member_count<T>();
#define PL_LAYOUT_CASE(n, ...)                                                                                       \
    if constexpr (kCount == n) {                                                                                     \
        auto& [__VA_ARGS__] = value;                                                                                 \
        return std::tie(__VA_ARGS__);                                                                                \
    } else
    // clang-format off
    PL_LAYOUT_CASE(1, m1)
    PL_LAYOUT_CASE(2, m1, m2)
    PL_LAYOUT_CASE(3, m1, m2, m3)
    PL_LAYOUT_CASE(4, m1, m2, m3, m4)
    PL_LAYOUT_CASE(5, m1, m2, m3, m4, m5)
    PL_LAYOUT_CASE(6, m1, m2, m3, m4, m5, m6)
    PL_LAYOUT_CASE(7, m1, m2, m3, m4, m5, m6, m7)
    PL_LAYOUT_CASE(8, m1, m2, m3, m4, m5, m6, m7, m8)
    PL_LAYOUT_CASE(9, m1, m2, m3, m4, m5, m6, m7, m8, m9)
    PL_LAYOUT_CASE(10, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10)
    PL_LAYOUT_CASE(11, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11)
    PL_LAYOUT_CASE(12, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12)
    PL_LAYOUT_CASE(13, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13)
    PL_LAYOUT_CASE(14, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14)
    PL_LAYOUT_CASE(15, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15)
    PL_LAYOUT_CASE(16, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16)
    PL_LAYOUT_CASE(17, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17)
    PL_LAYOUT_CASE(18, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18)
    PL_LAYOUT_CASE(19, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18, m19)
    PL_LAYOUT_CASE(20, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18, m19, m20)
    PL_LAYOUT_CASE(21, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18, m19, m20, m21)
    PL_LAYOUT_CASE(22, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18, m19, m20, m21, m22)
    PL_LAYOUT_CASE(23, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18, m19, m20, m21, m22, m23)
    PL_LAYOUT_CASE(24, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18, m19, m20, m21, m22, m23, m24)
    PL_LAYOUT_CASE(25, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18, m19, m20, m21, m22, m23, m24, m25)
    PL_LAYOUT_CASE(26, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18, m19, m20, m21, m22, m23, m24, m25, m26)
    PL_LAYOUT_CASE(27, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18, m19, m20, m21, m22, m23, m24, m25, m26, m27)
    PL_LAYOUT_CASE(28, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18, m19, m20, m21, m22, m23, m24, m25, m26, m27, m28)
    PL_LAYOUT_CASE(29, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18, m19, m20, m21, m22, m23, m24, m25, m26, m27, m28, m29)
    PL_LAYOUT_CASE(30, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18, m19, m20, m21, m22, m23, m24, m25, m26, m27, m28, m29, m30)
    PL_LAYOUT_CASE(31, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18, m19, m20, m21, m22, m23, m24, m25, m26, m27, m28, m29, m30, m31)
    PL_LAYOUT_CASE(32, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18, m19, m20, m21, m22, m23, m24, m25, m26, m27, m28, m29, m30, m31, m32)
    PL_LAYOUT_CASE(33, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18, m19, m20, m21, m22, m23, m24, m25, m26, m27, m28, m29, m30, m31, m32, m33)
    PL_LAYOUT_CASE(34, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18, m19, m20, m21, m22, m23, m24, m25, m26, m27, m28, m29, m30, m31, m32, m33, m34)
    PL_LAYOUT_CASE(35, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18, m19, m20, m21, m22, m23, m24, m25, m26, m27, m28, m29, m30, m31, m32, m33, m34, m35)
    PL_LAYOUT_CASE(36, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18, m19, m20, m21, m22, m23, m24, m25, m26, m27, m28, m29, m30, m31, m32, m33, m34, m35, m36)
    PL_LAYOUT_CASE(37, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18, m19, m20, m21, m22, m23, m24, m25, m26, m27, m28, m29, m30, m31, m32, m33, m34, m35, m36, m37)
    PL_LAYOUT_CASE(38, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18, m19, m20, m21, m22, m23, m24, m25, m26, m27, m28, m29, m30, m31, m32, m33, m34, m35, m36, m37, m38)
    PL_LAYOUT_CASE(39, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18, m19, m20, m21, m22, m23, m24, m25, m26, m27, m28, m29, m30, m31, m32, m33, m34, m35, m36, m37, m38, m39)
    PL_LAYOUT_CASE(40, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11, m12, m13, m14, m15, m16, m17, m18, m19, m20, m21, m22, m23, m24, m25, m26, m27, m28, m29, m30, m31, m32, m33, m34, m35, m36, m37, m38, m39, m40)
    return std::tuple<>{};
    // clang-format on
#undef PL_LAYOUT_CASE
}

/// Classes with bases are listed by hand; the count of initializers, bases included, tells if a member is missing.
template <class Base, class T>
PL_HD constexpr Base& base_of(T& value) {
    return value;
}
PL_HD constexpr auto members(Affine& v) {
    static_assert(sizeof v == 3 * sizeof v.rows[0]);
    return std::tie(v.rows[0], v.rows[1], v.rows[2]);
}
PL_HD constexpr auto members(FieldView& v) {
    const auto all = std::tie(base_of<PlacementView>(v), v.cells, v.light_clusters, v.radiance_unit, v.writers);
    static_assert(std::tuple_size_v<decltype(all)> == member_count<FieldView>());
    return all;
}
template <template <class> class Learned>
PL_HD constexpr auto members(TableArrays<Learned, Span>& v) {
    const auto all =
        std::tie(base_of<MixtureSums<Learned, Span>>(v), base_of<LightSampleSums<Learned, Span>>(v), v.radiance,
                 v.visits, v.pending_sum, v.pending_count, v.row_cdf, v.column_cdf, v.mean_radiance, v.change,
                 v.pending_distance, v.pending_light, v.reach_distance, v.reach_weight, v.inverse_reach);
    static_assert(std::tuple_size_v<decltype(all)> == member_count<TableArrays<Learned, Span>>());
    return all;
}
PL_HD constexpr auto members(TableView& v) {
    const auto all = std::tie(base_of<FieldView>(v), base_of<TableArrays<ConstSpan, Span>>(v), v.records);
    static_assert(std::tuple_size_v<decltype(all)> == member_count<TableView>());
    return all;
}
PL_HD constexpr auto members(TableField& v) {
    static_assert(member_count<TableField>() == 1);
    return std::tie(base_of<TableView>(v));
}
PL_HD constexpr auto members(NetworkField& v) {
    const auto all = std::tie(base_of<TableField>(v), v.evaluate, v.weights, v.counts, v.corner, v.edge);
    static_assert(std::tuple_size_v<decltype(all)> == member_count<NetworkField>());
    return all;
}
PL_HD constexpr auto members(cuda::ThreadNeuralField& v) {
    static_assert(member_count<cuda::ThreadNeuralField>() == 1);
    return std::tie(base_of<NetworkField>(v));
}
PL_HD constexpr auto members(TableUpdateView& v) {
    const auto all = std::tie(base_of<TableArrays<Span, Span>>(v), v.cells, v.light_clusters, v.radiance_unit,
                              v.extent, v.rate, v.uniform_floor);
    static_assert(std::tuple_size_v<decltype(all)> == member_count<TableUpdateView>());
    return all;
}

/// The type that a pointer to values or a span refers to; void for other types.
template <class T>
struct Target {
    using Type = void;
};
template <class T>
struct Target<T*> {
    using Type = std::remove_const_t<T>;
};
template <class Result, class... Parameters>
struct Target<Result (*)(Parameters...)> {
    using Type = void;
};
template <class T>
struct Target<Span<T>> {
    using Type = std::remove_const_t<T>;
};

/// Whether a type has members to walk; the others count by their size: numbers, vectors, pointers, classes with private members.
template <class T>
inline constexpr bool kHasMembers = std::is_class_v<T>&& std::is_aggregate_v<T> && !std::is_empty_v<T>;

/// Calls sink.type<T>(size, alignment) for a type, then sink.member<M>(offset) for its members, each followed by the same of the
/// member's own type, and of the type that it refers to.
template <class T, class Sink>
PL_HD inline void walk(Sink& sink) {
    sink.template type<T>(sizeof(T), alignof(T));
    // No object is there, and none is needed: the address of a member is all that is asked for.
    constexpr std::uintptr_t kAddress = 1u << 16;
    T& value = *reinterpret_cast<T*>(kAddress);
    const auto visit = [&](auto& member) {
        using M = std::remove_reference_t<decltype(member)>;
        sink.template member<M>(static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(&member) - kAddress));
        walk<M>(sink);
    };
    if constexpr (GuidedMethod<T>) {
        visit(value.field);
        visit(value.mixture);
    } else if constexpr (kHasMembers<T>) {
        std::apply([&](auto&... member) { (visit(member), ...); }, members(value));
    }
    using Referred = typename Target<T>::Type;
    if constexpr (!std::is_void_v<Referred>) walk<Referred>(sink);
}

template <class Sink, class... Parameters>
PL_HD inline void walk_parameters(Sink& sink, void (*)(Parameters...)) {
    (walk<std::remove_const_t<Parameters>>(sink), ...);
}

/// The parameters of all kernels of kernels.h, and all that they refer to.
template <class Sink, int kEntry = 0>
PL_HD inline void walk_kernels(Sink& sink) {
    if constexpr (kEntry < MethodList::kCount) {
        walk_parameters(sink, cuda::PictureKernel<cuda::KernelMethodAt<kEntry>>{});
        walk_kernels<Sink, kEntry + 1>(sink);
    } else {
        walk_parameters(sink, cuda::ProbeKernel{});
        walk_parameters(sink, cuda::ViewKernel{});
        walk_parameters(sink, cuda::EmissionKernel{});
        walk_parameters(sink, cuda::GatherRecordsKernel{});
        walk_parameters(sink, cuda::VolumeValueKernel{});
        walk_parameters(sink, cuda::AddSamplesKernel{});
        walk_parameters(sink, cuda::ReadFilmKernel{});
        walk_parameters(sink, cuda::ReadHalvesKernel{});
        walk_parameters(sink, cuda::ShowFilmKernel{});
        walk_parameters(sink, cuda::LargestValueKernel{});
        walk_parameters(sink, cuda::UpdateKernel{});
    }
}

}  // namespace pl::layout
