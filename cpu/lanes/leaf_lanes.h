// One ray and the triangles of a leaf, of which each has a lane. Included by one file per instruction set; see lanes.h.
#pragma once

#include "cpu/base/lane_kernels.h"
#include "cpu/lanes/lane_triangle.h"
#include "cpu/lanes/node_walk.h"

namespace pl {
namespace {

using TestSpace = RaySpace<TestFloat, TestInt>;
using TestCorner = RayVector<TestFloat>;
using FourLanes = float __attribute__((vector_size(16)));

// Shuffles of vectors of one or two blocks of four lanes.
#if defined(__AVX2__)
/// Four numbers of a triangle, and of the fourth next one.
PL_INLINE TestFloat load_blocks(const float* low, const float* high) {
    return __builtin_shufflevector(load_lanes<FourLanes>(low), load_lanes<FourLanes>(high), 0, 1, 2, 3, 4, 5, 6, 7);
}
/// In each block: the lanes i and i + 1 of `a`, then of `b`.
template <int i>
PL_INLINE TestFloat join(TestFloat a, TestFloat b) {
    return __builtin_shufflevector(a, b, i, i + 1, i + 8, i + 9, i + 4, i + 5, i + 12, i + 13);
}
/// In each block: the lanes i and i + 1 of `a` and `b` in turn.
template <int i>
PL_INLINE TestFloat interleave(TestFloat a, TestFloat b) {
    return __builtin_shufflevector(a, b, i, i + 8, i + 1, i + 9, i + 4, i + 12, i + 5, i + 13);
}
#else
PL_INLINE TestFloat load_blocks(const float* low, const float*) { return load_lanes<TestFloat>(low); }
template <int i>
PL_INLINE TestFloat join(TestFloat a, TestFloat b) {
    return __builtin_shufflevector(a, b, i, i + 1, i + 4, i + 5);
}
template <int i>
PL_INLINE TestFloat interleave(TestFloat a, TestFloat b) {
    return __builtin_shufflevector(a, b, i, i + 4, i + 1, i + 5);
}
#endif

/// The triangles of a leaf from number `first` on; lanes beyond the last one repeat it.
class LeafTriangles {
public:
    PL_INLINE LeafTriangles(const BvhTriangle* triangles, WideReference leaf, std::uint32_t first) {
        for (std::uint32_t i = 0; i < kTestWidth; ++i)
            triangles_[i] = &triangles[leaf.first() + min_of(first + i, leaf.count() - 1)].p0.x;
    }

    /// One corner: rows of x, y, z and the number that follows them.
    PL_INLINE void load(std::uint32_t corner, TestFloat (&rows)[4]) const {
        TestFloat r[4];
        for (std::uint32_t i = 0; i < 4; ++i)
            r[i] = load_blocks(triangles_[i] + 4 * corner, triangles_[(i + 4) % kTestWidth] + 4 * corner);
        const TestFloat xy01 = interleave<0>(r[0], r[1]);
        const TestFloat zw01 = interleave<2>(r[0], r[1]);
        const TestFloat xy23 = interleave<0>(r[2], r[3]);
        const TestFloat zw23 = interleave<2>(r[2], r[3]);
        rows[0] = join<0>(xy01, xy23);
        rows[1] = join<2>(xy01, xy23);
        rows[2] = join<0>(zw01, zw23);
        rows[3] = join<2>(zw01, zw23);
    }

private:
    const float* triangles_[kTestWidth];
};

/// The triangles of a leaf from index `first` on, read from a LeafBlock.
class BlockTriangles {
public:
    PL_INLINE BlockTriangles(const LeafBlock* blocks, WideReference leaf, std::uint32_t first)
        : block_(blocks[leaf.first()]), first_(first) {}

    PL_INLINE void load(std::uint32_t corner, TestFloat (&rows)[4]) const {
        for (std::uint32_t axis = 0; axis < 3; ++axis)
            rows[axis] = load_lanes<TestFloat>(block_.corners[corner][axis] + first_);
        rows[3] = load_lanes<TestFloat>(block_.primitives + first_);
    }

private:
    const LeafBlock& block_;
    std::uint32_t first_;
};

PL_INLINE LeafTriangles triangles_of(const BvhTriangle* triangles, WideReference leaf, std::uint32_t first) {
    return {triangles, leaf, first};
}
PL_INLINE BlockTriangles triangles_of(const LeafBlock* blocks, WideReference leaf, std::uint32_t first) {
    return {blocks, leaf, first};
}

/// HitGroup::set(), inlined.
PL_INLINE void store_hit(const Hit& hit, HitGroup& group, std::uint32_t lane) {
    group.t[lane] = hit.t;
    group.primitive[lane] = hit.primitive;
    group.b1[lane] = hit.b1;
    group.b2[lane] = hit.b2;
}

/// The triangles that a ray ignores, see Ray.
struct ExcludedPair {
    std::uint32_t source, target;
};

/// Triangles as they are.
struct AsStored {
    PL_INLINE void place(TestFloat (&)[4]) const {}
    PL_INLINE TestUint primitives(TestUint stored) const { return stored; }
};

/// Tests the triangles of a leaf and updates the closest hit. Returns true if there is one and any will do.
template <bool kAny>
class LeafTest {
public:
    PL_INLINE LeafTest(const PreparedGroup& group, std::uint32_t lane)
        : space_{broadcast_to<TestFloat>(group.origin[0][lane]),
                 broadcast_to<TestFloat>(group.origin[1][lane]),
                 broadcast_to<TestFloat>(group.origin[2][lane]),
                 broadcast_to<TestFloat>(group.shear_x[lane]),
                 broadcast_to<TestFloat>(group.shear_y[lane]),
                 broadcast_to<TestFloat>(group.scale_z[lane]),
                 {},
                 {}},
          first_axis_(group.first_axis[lane]) {}

    /// `leaves`: BvhView::triangles or blocks. `placing` takes stored rows of corners, and stored numbers of
    /// triangles, to the rows and numbers of the scene.
    template <class Stored, class Placing = AsStored>
    PL_INLINE bool find(const Stored* leaves, WideReference leaf, const ExcludedPair& excluded, Hit& best,
                        const Placing& placing = {}) const {
        for (std::uint32_t first = 0; first < leaf.count(); first += kTestWidth)
            if (find_in(triangles_of(leaves, leaf, first), leaf.count() - first, excluded, best, placing))
                return true;
        return false;
    }

private:
    /// Axes are permuted here, where it is a matter of addresses, and the space permutes none.
    PL_INLINE TestCorner to_space(const TestFloat (&rows)[4]) const {
        constexpr std::uint32_t kCyclic[] = {0, 1, 2, 0, 1};
        return to_ray_space(space_, rows[first_axis_], rows[kCyclic[first_axis_ + 1]],
                            rows[kCyclic[first_axis_ + 2]]);
    }

    template <class Triangles, class Placing>
    PL_INLINE bool find_in(const Triangles& triangles, std::uint32_t count, const ExcludedPair& without, Hit& best,
                           const Placing& placing) const {
        TestFloat rows[3][4];
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            triangles.load(corner, rows[corner]);
            placing.place(rows[corner]);
        }
        const TestCorner a = to_space(rows[0]);
        const TestCorner b = to_space(rows[1]);
        const TestCorner c = to_space(rows[2]);
        const auto [e, inside] = test_lines(a, b, c);
        const TestUint primitive = placing.primitives(std::bit_cast<TestUint>(rows[0][3]));
        const TestInt excluded = (primitive == without.source) | (primitive == without.target);
        std::uint32_t lanes = mask_bits(inside & ~excluded) & ((2u << (count - 1)) - 1u);
        if (lanes == 0) return false;
        const TestFloat determinant = e.u + e.v + e.w;
        const TestFloat t = scaled_distance(e, a, b, c) / determinant;
        lanes &= mask_bits((t > 0.0f) & (t <= best.t));
        if (kAny && lanes == 0) return false;
        for (; lanes != 0; lanes &= lanes - 1) {
            const auto i = static_cast<std::uint32_t>(std::countr_zero(lanes));
            if (t[i] < best.t || (t[i] == best.t && primitive[i] < best.primitive))
                best = {t[i], primitive[i], e.v[i] / determinant[i], e.w[i] / determinant[i]};
        }
        return kAny;
    }

    TestSpace space_;
    std::uint32_t first_axis_;
};

}  // namespace
}  // namespace pl
