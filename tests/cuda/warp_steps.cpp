// warp_steps [SCENE...]: the steps of warps that trace rays of adjacent paths, by each traversal of the device. A warp takes a step
// if any of its lanes does; the others wait. Runs the traversals themselves, on the host, a lane at a time: the counts
// are as on a device whose lanes meet at the end of every step. Table of docs/cuda.md. `ballN` is the ball with N rows of
// tests/support/scenes/bumpy_ball.h.
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/load_scene.h"
#include "core/kernel/geometry/postponed_traversal.h"
#include "core/kernel/geometry/small_scene.h"
#include "core/kernel/integrator/trace_path.h"
#include "core/kernel/methods/default.h"
#include "core/scene/pack_scene.h"
#include "tests/support/files/temporary_folder.h"
#include "tests/support/scenes/bumpy_ball.h"

using namespace pl;

namespace {

constexpr std::size_t kLanes = 32;
constexpr int kSide = 512;
constexpr int kWarps = 300;
constexpr int kSegments = 12;
/// Until paths have bounced, and lanes with short ones have begun others.
constexpr int kFirstSegment = 3;
constexpr FeatureSet kFeatures = kEveryFeature.without(Feature::NextEventEstimation);

using State = PathState<kFeatures, DefaultMethod>;

/// Steps of a kind: of warps, and of lanes.
struct Steps {
    std::uint64_t warps = 0;
    std::uint64_t lanes = 0;
};
/// Boxes of one node, of a pair of nodes; triangles of a leaf.
struct Counts {
    Steps boxes, pairs, triangles;
};

/// One lane on its way: the ray, and its closest hit so far.
struct Lane {
    const Ray* ray;
    ScalarRaySpace space;
    Hit best;

    explicit Lane(const Ray& of) : ray(&of), space(make_ray_space(of)), best{.t = of.t_max} {}

    /// Number of triangles tested.
    std::uint32_t visit(const BvhTriangle* triangles, NodeReference leaf) {
        visit_leaf(triangles, leaf, best, [&](const BvhTriangle& triangle, Hit& hit) {
            if (triangle.primitive != ray->source)
                intersect_triangle(space, triangle.p0, triangle.p1, triangle.p2, triangle.primitive, hit);
            return false;
        });
        return leaf.count();
    }
};

std::vector<Lane> lanes_of(const std::vector<Ray>& rays) { return {rays.begin(), rays.end()}; }

/// The steps of traverse() of a hierarchy, in its order: a lane visits each leaf before it goes on. In each a lane
/// either meets a pair of nodes, step(0), or the triangles of a leaf, step(triangles).
template <class Step>
void walk_plain(const BvhView& bvh, Lane& lane, Step&& step) {
    NodeMemory memory;
    PostponedTraversal way(bvh, *lane.ray, lane.best.t, memory);
    while (way.is_at_inner_node() || way.has_leaf()) {
        if (way.has_leaf()) {
            step(lane.visit(bvh.triangles.data, way.take_leaf()));
        } else {
            step(0u);
            way.descend(lane.best.t);
        }
    }
}

void count_plain(const BvhView& bvh, const std::vector<Ray>& rays, Counts& counts) {
    std::vector<std::uint32_t> most_triangles;  // of any lane, by step
    std::vector<bool> meets_pair;
    for (Lane& lane : lanes_of(rays)) {
        std::size_t step = 0;
        walk_plain(bvh, lane, [&](std::uint32_t triangles) {
            if (step == meets_pair.size()) {
                meets_pair.push_back(false);
                most_triangles.push_back(0);
            }
            if (triangles == 0) meets_pair[step] = true;
            most_triangles[step] = std::max(most_triangles[step], triangles);
            ++(triangles == 0 ? counts.pairs.lanes : counts.triangles.lanes);
            if (triangles > 1) counts.triangles.lanes += triangles - 1;
            ++step;
        });
    }
    for (std::size_t step = 0; step < meets_pair.size(); ++step) {
        counts.pairs.warps += meets_pair[step] ? 1 : 0;
        counts.triangles.warps += most_triangles[step];
    }
}

/// A warp that postpones leaves: the loops of traverse(PostponingBvh) for all lanes at once.
class PostponingWarp {
public:
    PostponingWarp(const BvhView& bvh, const std::vector<Ray>& rays, Counts& counts)
        : bvh_(bvh), lanes_(lanes_of(rays)), memories_(rays.size()), counts_(counts) {
        for (std::size_t i = 0; i < rays.size(); ++i) ways_.emplace_back(bvh, rays[i], rays[i].t_max, memories_[i]);
    }

    void run() {
        while (!std::ranges::all_of(ways_, &PostponedTraversal::is_over)) {
            while (std::ranges::any_of(ways_, &PostponedTraversal::looks_for_leaf)) descend();
            visit();
        }
    }

private:
    void descend() {
        ++counts_.pairs.warps;
        for (std::size_t i = 0; i < ways_.size(); ++i) {
            if (!ways_[i].is_at_inner_node()) continue;
            ++counts_.pairs.lanes;
            ways_[i].descend(lanes_[i].best.t);
        }
    }
    void visit() {
        std::uint32_t most = 0;
        for (std::size_t i = 0; i < ways_.size(); ++i) {
            if (!ways_[i].has_leaf()) continue;
            const std::uint32_t tested = lanes_[i].visit(bvh_.triangles.data, ways_[i].take_leaf());
            counts_.triangles.lanes += tested;
            most = std::max(most, tested);
        }
        counts_.triangles.warps += most;
    }

    const BvhView& bvh_;
    std::vector<Lane> lanes_;
    std::vector<NodeMemory> memories_;
    std::vector<PostponedTraversal> ways_;
    Counts& counts_;
};

void count_postponed(const BvhView& bvh, const std::vector<Ray>& rays, Counts& counts) {
    PostponingWarp(bvh, rays, counts).run();
}

/// traverse(SmallScene): all boxes, then the triangles of the leaves that a lane enters.
void count_small(const BvhView& bvh, const std::vector<Ray>& rays, Counts& counts) {
    const SmallScene scene{bvh.nodes.data, bvh.leaves.data, bvh.triangles.data, bvh.leaves.count};
    counts.boxes.warps += bvh.leaves.count;
    counts.boxes.lanes += bvh.leaves.count * rays.size();
    std::uint32_t most = 0;
    for (const Ray& ray : rays) {
        SmallTriangles entered = entered_triangles(scene, ray, ray.t_max);
        std::uint32_t tested = 0;
        for (; !entered.empty(); ++tested) (void)entered.take();
        counts.triangles.lanes += tested;
        most = std::max(most, tested);
    }
    counts.triangles.warps += most;
}

/// Notes the ray of each segment.
struct NotingIntersector {
    BvhIntersector intersector;
    Ray* ray;

    Hit closest_hit(const Ray& traced) const {
        *ray = traced;
        return intersector.closest_hit(traced);
    }
    bool occluded(const Ray& traced) const { return intersector.occluded(traced); }
};

/// Calls visit(rays) with the rays that a warp traces at once: lanes claim adjacent pixels, again when a path has ended.
template <class Visit>
void trace_warp(const SceneView& scene, const Camera& camera, std::uint32_t first, Visit&& visit) {
    const DefaultMethod method;
    const PathSettings settings;
    const PathContext<DefaultMethod> context{scene, method, settings};
    std::uint32_t next = first;
    const auto begin = [&] {
        return begin_path<kFeatures, DefaultMethod>(camera, settings, {kSide, kSide, 0}, next++ % (kSide * kSide));
    };
    std::vector<State> states;
    for (std::size_t i = 0; i < kLanes; ++i) states.push_back(begin());
    std::vector<Ray> rays(kLanes);
    PathCounters counters;
    for (int segment = 0; segment < kSegments; ++segment) {
        for (std::size_t i = 0; i < kLanes; ++i) {
            Ray ray;
            const NotingIntersector intersector{BvhIntersector{scene}, &ray};
            const PathStatus status = trace_segment<kFeatures>(context, intersector, states[i], counters);
            if (status == PathStatus::Finished) states[i] = begin();
            rays[i] = ray;
        }
        if (segment >= kFirstSegment) visit(rays);
    }
}

void print(const std::string& scene, const char* traversal, const Counts& counts, std::uint64_t warps) {
    const auto share = [&](std::uint64_t steps) { return static_cast<double>(steps) / static_cast<double>(warps); };
    const auto both = [&](const Steps& steps) {
        return fmt::format("{:6.1f} {:6.1f}", share(steps.warps), share(steps.lanes) / static_cast<double>(kLanes));
    };
    fmt::print("{:<12} {:<10} {} {} {}\n", scene, traversal, both(counts.boxes), both(counts.pairs),
               both(counts.triangles));
}

void count_scene(const std::string& name) {
    test::TemporaryFolder folder;
    const bool is_ball = name.starts_with("ball");
    const std::string place =
        is_ball ? test::write_bumpy_ball(folder.path(), std::stoul(name.substr(4))).string() : name;
    const SceneDescription description = load_scene(place, find_assets_dir());
    const HostScene packed = pack_scene(description);
    const SceneView scene = packed.view();
    const Camera camera = make_camera(description.camera, kSide, kSide);
    Counts plain, postponed, small;
    std::uint64_t warps = 0;
    for (std::uint32_t warp = 0; warp < kWarps; ++warp)
        trace_warp(scene, camera, warp * 7919u * kLanes, [&](const std::vector<Ray>& rays) {
            ++warps;
            count_plain(scene.bvh, rays, plain);
            count_postponed(scene.bvh, rays, postponed);
            count_small(scene.bvh, rays, small);
        });
    print(name, "plain", plain, warps);
    print(name, "postponed", postponed, warps);
    if (!scene.bvh.leaves.empty()) print(name, "small", small, warps);
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::string> scenes(argv + 1, argv + argc);
    if (scenes.empty()) scenes = {"cornell", "door", "staircase", "ball501"};
    try {
        fmt::print("Steps of a warp, and of a lane, per ray\n{:<12} {:<10} {:>13} {:>13} {:>13}\n", "scene",
                   "traversal", "boxes", "pairs", "triangles");
        for (const std::string& scene : scenes) count_scene(scene);
        return 0;
    } catch (const Error& error) {
        std::fprintf(stderr, "warp_steps: %s\n", error.what());
        return static_cast<int>(error.kind());
    }
}
