// One step of building a hierarchy: boxes of triangles, and where to split a set of them.   [Wald 2007, "On fast
// Construction of SAH-based Bounding Volume Hierarchies"]
#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <span>

#include "core/kernel/base/math.h"

namespace pl {

/// x, y, z and a number without meaning, in one vector register.
using BuildVector = float __attribute__((vector_size(16)));

/// Half of the area of a box of this size. In double, so that areas of scenes of any valid size neither overflow nor underflow.
inline double half_area(const Vec3d& size) { return size.x * size.y + size.y * size.z + size.z * size.x; }

/// The first of several equal corners counts, so that a box of boxes is the box of their points in order, to the sign
/// of a zero.
struct BuildBox {
    BuildVector low{kInfinity, kInfinity, kInfinity, kInfinity};
    BuildVector high{-kInfinity, -kInfinity, -kInfinity, -kInfinity};

    void add(BuildVector point) { add({point, point}); }
    void add(const BuildBox& other) {
        low = other.low < low ? other.low : low;
        high = other.high > high ? other.high : high;
    }
    double half_area() const {
        return pl::half_area(Vec3d{high[0], high[1], high[2]} - Vec3d{low[0], low[1], low[2]});
    }
};

/// The axes of space, and one of sizes: a set of walls and of small things between them has a box as large as the room, and no plane
/// separates the two.
inline constexpr int kSizeAxis = 3;
inline constexpr int kSplitAxes = 4;

/// The box of a triangle, and in the places without meaning its number and its size.
class BuildTriangle {
public:
    BuildTriangle() = default;
    BuildTriangle(const BuildBox& box, std::uint32_t number) : low_(box.low), high_(box.high) {
        low_[3] = std::bit_cast<float>(kNormalFloat | number);
        high_[3] = size_of(box);
    }

    BuildBox box() const { return {low_, high_}; }
    /// The center of the box; the place on the axis of sizes behind it.
    BuildVector center() const {
        BuildVector center = 0.5f * low_ + 0.5f * high_;
        center[kSizeAxis] = high_[kSizeAxis];
        return center;
    }
    std::uint32_t number() const { return std::bit_cast<std::uint32_t>(low_[3]) & ~kNormalFloat; }

private:
    /// Sets the exponent of numbers below kMaxBvhTriangles: arithmetic on subnormal floats is slow.
    static constexpr std::uint32_t kNormalFloat = 0x40000000u;

    /// Nearly the logarithm of the box's area: the bits of a float, without the lowest eight.
    static float size_of(const BuildBox& box) {
        return static_cast<float>(std::bit_cast<std::uint32_t>(static_cast<float>(box.half_area())) >> 8);
    }

    BuildVector low_;
    BuildVector high_;
};

/// Maps centers to bins, along all axes at once; monotone, so that equal centers share a bin.
class Binning {
public:
    static constexpr int kBins = 16;
    using Bins = std::int32_t __attribute__((vector_size(16)));

    /// Axes along which the centers do not differ, or too little for a float, have one bin.
    explicit Binning(const BuildBox& centers) : low_(centers.low) {
        for (int axis = 0; axis < kSplitAxes; ++axis) {
            const float extent = centers.high[axis] - centers.low[axis];
            const float scale = static_cast<float>(kBins) / extent;
            if (extent > 0.0f && extent < kInfinity && scale < kInfinity) scale_[axis] = scale;
        }
    }

    bool divides(int axis) const { return scale_[axis] > 0.0f; }

    Bins bins_of(BuildVector center) const {
        constexpr BuildVector kEnd{kBins, kBins, kBins, kBins};
        const BuildVector position = (center - low_) * scale_;
        return __builtin_convertvector(position < kEnd ? position : kEnd - 1.0f, Bins);
    }

private:
    BuildVector low_;
    BuildVector scale_{0.0f, 0.0f, 0.0f, 0.0f};
};

struct BuildSplit {
    int axis = -1;                                          ///< -1: none found
    int bin = 0;                                            ///< last bin of the lower side
    std::uint32_t lower = 0;                                ///< triangles of the lower side
    double cost = std::numeric_limits<double>::infinity();  ///< sum of half areas times triangles
};

/// Finds the split of least cost. Keeps its bins from one call to the next.
class SplitFinder {
public:
    BuildSplit find(std::span<const BuildTriangle> triangles, const Binning& binning) {
        const int axes = triangles.size() < kFewestForSizes ? kSizeAxis : kSplitAxes;
        fill(triangles, binning, axes);
        BuildSplit best;
        for (int axis = 0; axis < axes; ++axis) {
            Axis& along = axes_[axis];
            if (binning.divides(axis)) along.improve(axis, best);
            along.clear();
        }
        return best;
    }

private:
    /// Sets of fewer triangles are small themselves.
    static constexpr std::size_t kFewestForSizes = 64;

    struct Bin {
        BuildBox box;
        std::uint32_t count = 0;

        void add(const Bin& other) {
            box.add(other.box);
            count += other.count;
        }
        double cost() const { return box.half_area() * count; }
    };

    struct Axis {
        Bin bins[Binning::kBins];
        std::uint32_t used = 0;  ///< a bit per bin with triangles; most sets are small

        /// Splits behind each bin that has triangles, the last one excepted: splits between would be the same.
        void improve(int axis, BuildSplit& best) const {
            double upper_cost[Binning::kBins];
            Bin upper;
            for (std::uint32_t rest = used; rest != 0;) {
                const int i = std::bit_width(rest) - 1;
                upper_cost[i] = upper.count > 0 ? upper.cost() : 0.0;
                upper.add(bins[i]);
                rest ^= 1u << i;
            }
            Bin lower;
            for (std::uint32_t rest = used; (rest & (rest - 1)) != 0; rest &= rest - 1) {
                const int i = std::countr_zero(rest);
                lower.add(bins[i]);
                const double cost = lower.cost() + upper_cost[i];
                if (cost < best.cost) best = {axis, i, lower.count, cost};
            }
        }

        void clear() {
            for (; used != 0; used &= used - 1) bins[std::countr_zero(used)] = {};
        }
    };

    void fill(std::span<const BuildTriangle> triangles, const Binning& binning, int axes) {
        std::uint32_t used[kSplitAxes] = {};
        for (const BuildTriangle& triangle : triangles) {
            const Binning::Bins bins = binning.bins_of(triangle.center());
            for (int axis = 0; axis < axes; ++axis) {
                Bin& bin = axes_[axis].bins[bins[axis]];
                bin.box.add(triangle.box());
                ++bin.count;
                used[axis] |= 1u << bins[axis];
            }
        }
        for (int axis = 0; axis < axes; ++axis) axes_[axis].used = used[axis];
    }

    Axis axes_[kSplitAxes];
};

}  // namespace pl
