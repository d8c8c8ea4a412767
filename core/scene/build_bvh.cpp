#include "core/scene/build_bvh.h"

#include <algorithm>
#include <bit>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/host_array.h"
#include "core/base/parallel.h"
#include "core/scene/bvh_split.h"
#include "core/scene/reinsert_bvh.h"

namespace pl {
namespace {

/// Cost of visiting an inner node, in triangle tests.
constexpr double kNodeCost = 1.0;

/// Subtrees of at most so many triangles are built by one thread.
constexpr std::uint32_t kSubtree = 8192;

Vec3f xyz(BuildVector v) { return {v[0], v[1], v[2]}; }

/// A set of triangles, to become a node: [first, first + count) of all.
struct BuildSet {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    int depth = 0;   ///< of the node; the root has 0
    int buffer = 0;  ///< of BuildTriangles that holds them
    BuildBox bounds{};
    BuildBox centers{};

    void add(const BuildTriangle& triangle) {
        bounds.add(triangle.box());
        centers.add(triangle.center());
    }
};

/// All triangles, in an order in which the triangles of each set are neighbors. Dividing a set moves it from one
/// buffer to the other.
class BuildTriangles {
public:
    /// `box_of(i)`: the box of triangle i.
    template <class BoxOf>
    BuildTriangles(std::uint32_t count, int threads, const BoxOf& box_of)
        : buffers_{std::make_unique_for_overwrite<BuildTriangle[]>(count),
                   std::make_unique_for_overwrite<BuildTriangle[]>(count)},
          root_{.count = count} {
        const auto fill = [&](BuildSet& chunk, IndexRange range) {
            for (std::uint32_t i = range.begin; i < range.end; ++i) {
                buffers_[0][i] = {box_of(i), i};
                chunk.add(buffers_[0][i]);
            }
        };
        for (const BuildSet& chunk : sums_of_chunks(count, kElementChunk, threads, BuildSet{}, fill)) {
            root_.bounds.add(chunk.bounds);
            root_.centers.add(chunk.centers);
        }
    }

    const BuildSet& root() const { return root_; }
    std::span<BuildTriangle> of(const BuildSet& set) const { return {&buffers_[set.buffer][set.first], set.count}; }

    /// Splits a set between two bins, stably.
    std::pair<BuildSet, BuildSet> divide(const BuildSet& set, const Binning& binning, const BuildSplit& split) const {
        const int other = 1 - set.buffer;
        BuildTriangle* const to = &buffers_[other][set.first];
        BuildSet sides[2];
        std::uint32_t lower = 0;
        std::uint32_t upper = split.lower;
        for (const BuildTriangle& triangle : of(set)) {
            const int side = binning.bins_of(triangle.center())[split.axis] > split.bin ? 1 : 0;
            to[side == 0 ? lower : upper] = triangle;
            lower += static_cast<std::uint32_t>(1 - side);
            upper += static_cast<std::uint32_t>(side);
            sides[side].add(triangle);
        }
        return numbered(set, lower, other, sides);
    }

    /// Splits a set at the median along the longest axis; ties by number.
    std::pair<BuildSet, BuildSet> halve(const BuildSet& set) const {
        const Vec3f extent = xyz(set.centers.high - set.centers.low);
        int axis = extent.y > extent.x ? 1 : 0;
        if (extent.z > extent[axis]) axis = 2;
        const std::span<BuildTriangle> all = of(set);
        const std::uint32_t lower = set.count / 2;
        const auto less = [axis](const BuildTriangle& a, const BuildTriangle& b) {
            const float at = a.center()[axis], than = b.center()[axis];
            return at != than ? at < than : a.number() < b.number();
        };
        std::nth_element(all.begin(), all.begin() + lower, all.end(), less);
        BuildSet sides[2];
        for (std::uint32_t i = 0; i < set.count; ++i) sides[i < lower ? 0 : 1].add(all[i]);
        return numbered(set, lower, set.buffer, sides);
    }

private:
    static std::pair<BuildSet, BuildSet> numbered(const BuildSet& set, std::uint32_t lower, int buffer,
                                                  BuildSet (&sides)[2]) {
        sides[0].first = set.first;
        sides[0].count = lower;
        sides[1].first = set.first + lower;
        sides[1].count = set.count - lower;
        sides[0].depth = sides[1].depth = set.depth + 1;
        sides[0].buffer = sides[1].buffer = buffer;
        return {sides[0], sides[1]};
    }

    std::unique_ptr<BuildTriangle[]> buffers_[2];  ///< not initialized: threads touch them first
    BuildSet root_;
};

/// Turns sets into leaves or splits them. Not for two threads at once.
class SetSplitter {
public:
    /// Leaves, of at most `most` triangles, write the numbers of these.
    SetSplitter(const BuildTriangles& triangles, Span<std::uint32_t> numbers, std::uint32_t most)
        : triangles_(triangles), numbers_(numbers), most_(most) {}

    /// Fills the node, except for the children of an inner one; their sets are given to on_inner(lower, upper).
    template <class OnInner>
    void split(const BuildSet& set, BvhNode& node, OnInner&& on_inner) {
        node.low = xyz(set.bounds.low);
        node.high = xyz(set.bounds.high);
        const Binning binning(set.centers);
        const BuildSplit best = set.count < 2 ? BuildSplit{} : finder_.find(triangles_.of(set), binning);
        const double split_cost = kNodeCost + best.cost / set.bounds.half_area();
        if (set.count <= most_ && !(split_cost < static_cast<double>(set.count))) {
            node.first = set.first;
            node.count = set.count;
            std::uint32_t at = set.first;
            for (const BuildTriangle& triangle : triangles_.of(set)) numbers_[at++] = triangle.number();
            return;
        }
        const auto [lower, upper] =
            must_halve(set) || best.axis < 0 ? triangles_.halve(set) : triangles_.divide(set, binning, best);
        on_inner(lower, upper);
    }

private:
    /// True if only median splits, down to single triangles, keep the depth below kMaxBvhDepth.
    static bool must_halve(const BuildSet& set) {
        const int halvings = static_cast<int>(std::bit_width(set.count - 1));
        return set.depth + halvings + 1 >= kMaxBvhDepth - 1;
    }

    const BuildTriangles& triangles_;
    Span<std::uint32_t> numbers_;
    std::uint32_t most_;
    SplitFinder finder_;
};

/// A node of the upper part of the tree with its two branches, or a whole subtree.
struct Branch {
    BvhNode node;
    std::unique_ptr<Branch> lower, upper;
    std::vector<BvhNode> below;  ///< nodes of a subtree without its root `node`; they count from 0
};

/// Nodes in the order of a tree built depth first: the pair of a node's children, all below the lower, all below the
/// upper one.
class BranchBuilder {
public:
    BranchBuilder(const BuildTriangles& triangles, Span<std::uint32_t> numbers, std::uint32_t most)
        : splitter_(triangles, numbers, most) {}

    void build_subtree(const BuildSet& root, Branch& branch) {
        std::vector<BvhNode>& nodes = branch.below;
        nodes.reserve(root.count + root.count / 8);
        waiting_ = {{kRoot, root}};
        while (!waiting_.empty()) {
            const Waiting next = waiting_.back();
            waiting_.pop_back();
            BvhNode node;
            splitter_.split(next.set, node, [&](const BuildSet& lower, const BuildSet& upper) {
                node.first = static_cast<std::uint32_t>(nodes.size());
                nodes.resize(nodes.size() + 2);
                waiting_.push_back({node.first + 1, upper});
                waiting_.push_back({node.first, lower});
            });
            (next.node == kRoot ? branch.node : nodes[next.node]) = node;
        }
    }

    /// Calls on_inner(lower, upper) for the sets of the branches.
    template <class OnInner>
    void split(const BuildSet& set, Branch& branch, OnInner&& on_inner) {
        splitter_.split(set, branch.node, [&](const BuildSet& lower, const BuildSet& upper) {
            branch.lower = std::make_unique<Branch>();
            branch.upper = std::make_unique<Branch>();
            on_inner(lower, upper);
        });
    }

private:
    static constexpr std::uint32_t kRoot = 0xffffffffu;
    struct Waiting {
        std::uint32_t node;
        BuildSet set;
    };

    SetSplitter splitter_;
    std::vector<Waiting> waiting_;
};

/// Writes the root of a branch to `slot`, and appends the nodes below it.
void append_branch(Branch& branch, std::uint32_t slot, std::vector<BvhNode>& nodes) {
    const auto offset = static_cast<std::uint32_t>(nodes.size());
    const auto shifted = [offset](BvhNode node) {
        node.first += node.count == 0 ? offset : 0;
        return node;
    };
    nodes[slot] = shifted(branch.node);
    if (!branch.lower) {
        for (const BvhNode& node : branch.below) nodes.push_back(shifted(node));
        branch.below = {};
        return;
    }
    nodes.resize(nodes.size() + 2);
    append_branch(*branch.lower, offset, nodes);
    append_branch(*branch.upper, offset + 1, nodes);
}

std::size_t count_nodes(const Branch& branch) {
    return branch.lower ? 2 + count_nodes(*branch.lower) + count_nodes(*branch.upper) : branch.below.size();
}

void build_branches(const BuildTriangles& triangles, Span<std::uint32_t> numbers, std::uint32_t most, Branch& root,
                    int threads) {
    struct Task {
        BuildSet set;
        Branch* branch;
    };
    run_tasks(Task{triangles.root(), &root}, threads, [&](const Task& task, auto&& push) {
        BranchBuilder builder(triangles, numbers, most);
        if (task.set.count <= kSubtree) return builder.build_subtree(task.set, *task.branch);
        builder.split(task.set, *task.branch, [&](const BuildSet& lower, const BuildSet& upper) {
            push(Task{upper, task.branch->upper.get()});
            push(Task{lower, task.branch->lower.get()});
        });
    });
}

/// `most`: triangles of a leaf.
template <class BoxOf>
Bvh build(std::uint32_t count, std::uint32_t most, int threads, const BoxOf& box_of) {
    if (count > kMaxBvhTriangles)
        throw Error(ErrorKind::Input, fmt::format("bounding volume hierarchy: expected at most {} triangles, got {}",
                                                  kMaxBvhTriangles, count));
    if (count == 0) return {};
    if (threads <= 0) threads = usable_threads();
    Bvh bvh;
    bvh.primitives.resize(count);
    Branch root;
    build_branches(BuildTriangles(count, threads, box_of), view_of(bvh.primitives), most, root,
                   count <= kSubtree ? 1 : threads);
    bvh.nodes.reserve(1 + count_nodes(root));
    bvh.nodes.emplace_back();
    append_branch(root, 0, bvh.nodes);
    reinsert_nodes(bvh);
    return bvh;
}

BuildVector build_vector(const Vec3f& p) { return BuildVector{p.x, p.y, p.z, 0.0f}; }

}  // namespace

Bvh build_bvh(Span<const Vec3f> positions, Span<const Triangle> triangles, int threads) {
    return build(triangles.count, kMaxLeafSize, threads, [&](std::uint32_t i) {
        const Triangle& t = triangles[i];
        BuildBox box;
        for (const std::uint32_t vertex : {t.v0, t.v1, t.v2}) box.add(build_vector(positions[vertex]));
        return box;
    });
}

Bvh build_bvh(Span<const Bounds> boxes, int threads) {
    return build(boxes.count, 1, threads, [&](std::uint32_t i) {
        return BuildBox{build_vector(boxes[i].low), build_vector(boxes[i].high)};
    });
}

}  // namespace pl
