#include "core/scene/build_bvh.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"

namespace pl {
namespace {

constexpr int kBinCount = 16;
/// Cost of visiting an inner node, in triangle tests.
constexpr double kNodeCost = 1.0;

/// Bounds in double, so that areas of scenes of any valid size neither overflow nor underflow.
struct Box {
    Vec3f low{kInfinity};
    Vec3f high{-kInfinity};

    void add(Vec3f point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    void add(const Box& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
    double half_area() const {
        const Vec3d d = Vec3d{high} - Vec3d{low};
        return d.x * d.y + d.y * d.z + d.z * d.x;
    }
};

struct Primitive {
    Box box;
    Vec3f center;
    std::uint32_t id;
};

/// A node with primitives [first, first + count), not split yet.
struct Task {
    std::uint32_t node;
    std::uint32_t first;
    std::uint32_t count;
    int depth;  ///< of the node; the root has 0
};

struct Split {
    int axis = -1;  ///< -1: none found
    int bin = 0;    ///< last bin of the lower side
    double cost = std::numeric_limits<double>::infinity();
};

struct Bin {
    Box box;
    std::uint32_t count = 0;
};

/// Maps centers along one axis to bins; monotone, so that equal centers share a bin.
struct Binning {
    float low;
    float scale;

    Binning(const Box& centers, int axis)
        : low(centers.low[axis]), scale(static_cast<float>(kBinCount) / (centers.high[axis] - centers.low[axis])) {}

    int bin_of(float center) const {
        const float position = (center - low) * scale;
        return position < static_cast<float>(kBinCount) ? static_cast<int>(position) : kBinCount - 1;
    }
};

class BvhBuilder {
public:
    BvhBuilder(Span<const Vec3f> positions, Span<const Triangle> triangles) {
        primitives_.reserve(triangles.count);
        for (std::uint32_t id = 0; id < triangles.count; ++id) {
            const Triangle& t = triangles[id];
            Primitive primitive{{}, {}, id};
            for (const std::uint32_t corner : {t.v0, t.v1, t.v2}) primitive.box.add(positions[corner]);
            primitive.center = 0.5f * primitive.box.low + 0.5f * primitive.box.high;
            primitives_.push_back(primitive);
        }
    }

    Bvh build() {
        if (primitives_.empty()) return {};
        bvh_.nodes.reserve(primitives_.size());
        bvh_.nodes.emplace_back();
        std::vector<Task> tasks{{0, 0, static_cast<std::uint32_t>(primitives_.size()), 0}};
        while (!tasks.empty()) {
            const Task task = tasks.back();
            tasks.pop_back();
            split(task, tasks);
        }
        bvh_.primitives.reserve(primitives_.size());
        for (const Primitive& primitive : primitives_) bvh_.primitives.push_back(primitive.id);
        return std::move(bvh_);
    }

private:
    void split(const Task& task, std::vector<Task>& tasks) {
        const auto begin = primitives_.begin() + task.first;
        const auto end = begin + task.count;
        Box bounds, centers;
        for (auto p = begin; p != end; ++p) {
            bounds.add(p->box);
            centers.add(p->center);
        }
        BvhNode& node = bvh_.nodes[task.node];
        node.low = bounds.low;
        node.high = bounds.high;

        const Split best = best_split(task, centers);
        const double split_cost = kNodeCost + best.cost / bounds.half_area();
        if (task.count <= kMaxLeafSize && !(split_cost < static_cast<double>(task.count))) {
            node.first = task.first;
            node.count = task.count;
            return;
        }
        const std::uint32_t lower =
            must_halve(task) || best.axis < 0 ? halve(task, centers) : divide(task, centers, best);
        node.first = static_cast<std::uint32_t>(bvh_.nodes.size());
        node.count = 0;
        const std::uint32_t child = node.first;
        bvh_.nodes.resize(bvh_.nodes.size() + 2);
        tasks.push_back({child + 1, task.first + lower, task.count - lower, task.depth + 1});
        tasks.push_back({child, task.first, lower, task.depth + 1});
    }

    /// True if only median splits, down to single primitives, keep the depth below kMaxBvhDepth.
    static bool must_halve(const Task& task) {
        const int halvings = static_cast<int>(std::bit_width(task.count - 1));
        return task.depth + halvings + 1 >= kMaxBvhDepth - 1;
    }

    Split best_split(const Task& task, const Box& centers) const {
        Split best;
        if (task.count < 2) return best;
        for (int axis = 0; axis < 3; ++axis) {
            const float extent = centers.high[axis] - centers.low[axis];
            if (extent > 0.0f && extent < kInfinity) try_axis(task, centers, axis, best);
        }
        return best;
    }

    void try_axis(const Task& task, const Box& centers, int axis, Split& best) const {
        const Binning binning(centers, axis);
        if (!(binning.scale < kInfinity)) return;
        Bin bins[kBinCount];
        for (std::uint32_t i = task.first; i < task.first + task.count; ++i) {
            Bin& bin = bins[binning.bin_of(primitives_[i].center[axis])];
            bin.box.add(primitives_[i].box);
            ++bin.count;
        }
        double upper_cost[kBinCount];
        Bin upper;
        for (int i = kBinCount - 1; i > 0; --i) {
            upper.box.add(bins[i].box);
            upper.count += bins[i].count;
            upper_cost[i] = upper.count > 0 ? upper.box.half_area() * upper.count : -1.0;
        }
        Bin lower;
        for (int i = 0; i + 1 < kBinCount; ++i) {
            lower.box.add(bins[i].box);
            lower.count += bins[i].count;
            if (lower.count == 0 || upper_cost[i + 1] < 0.0) continue;
            const double cost = lower.box.half_area() * lower.count + upper_cost[i + 1];
            if (cost < best.cost) best = {axis, i, cost};
        }
    }

    /// Splits between two bins, stably; returns the number of primitives of the lower side.
    std::uint32_t divide(const Task& task, const Box& centers, const Split& best) {
        const Binning binning(centers, best.axis);
        const auto begin = primitives_.begin() + task.first;
        const auto middle = std::stable_partition(begin, begin + task.count, [&](const Primitive& p) {
            return binning.bin_of(p.center[best.axis]) <= best.bin;
        });
        return static_cast<std::uint32_t>(middle - begin);
    }

    /// Splits at the median along the longest axis; ties by primitive number.
    std::uint32_t halve(const Task& task, const Box& centers) {
        const Vec3f extent = centers.high - centers.low;
        int axis = extent.y > extent.x ? 1 : 0;
        if (extent.z > extent[axis]) axis = 2;
        const auto begin = primitives_.begin() + task.first;
        const std::uint32_t lower = task.count / 2;
        std::nth_element(begin, begin + lower, begin + task.count, [axis](const Primitive& a, const Primitive& b) {
            return a.center[axis] != b.center[axis] ? a.center[axis] < b.center[axis] : a.id < b.id;
        });
        return lower;
    }

    std::vector<Primitive> primitives_;
    Bvh bvh_;
};

}  // namespace

Bvh build_bvh(Span<const Vec3f> positions, Span<const Triangle> triangles) {
    if (triangles.count > kMaxBvhTriangles)
        throw Error(ErrorKind::Input, fmt::format("bounding volume hierarchy: expected at most {} triangles, got {}",
                                                  kMaxBvhTriangles, triangles.count));
    return BvhBuilder(positions, triangles).build();
}

}  // namespace pl
