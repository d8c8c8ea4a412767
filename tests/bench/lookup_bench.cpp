// The time of a lookup, at the hit points of diffuse paths.
// Usage: lookup_bench [SCENE [ROUNDS]]. The searches alternate, and have to agree at every point.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/timer.h"
#include "core/fields/place_volumes.h"
#include "core/fields/volume_grid.h"
#include "core/io/load_scene.h"
#include "core/kernel/base/rng.h"
#include "core/kernel/geometry/intersector.h"
#include "core/kernel/scene/camera.h"
#include "core/kernel/shading/lambert.h"
#include "core/scene/pack_scene.h"
#include "tests/bench/machine_load.h"
#include "tests/bench/quartiles.h"
#include "tests/support/field/linear_search.h"

namespace pl::benchmarks {
namespace {

constexpr std::uint32_t kPoints = 1u << 18;
constexpr std::uint32_t kSide = 512;  ///< of the picture whose paths are followed
constexpr std::uint32_t kMaxVertices = 8;

std::vector<SurfacePoint> path_vertices(const SceneView& scene, const Camera& camera) {
    const BvhIntersector intersector{scene};
    std::vector<SurfacePoint> points;
    for (std::uint32_t path = 0; points.size() < kPoints; ++path) {
        const Rng rng{.seed = 1, .pixel = path};
        const Vec4f u = rng.draw(0, Purpose::Scatter);
        Ray ray = generate_ray(camera, Vec2f{u.x, u.y} * static_cast<float>(kSide), Vec2f{kSide});
        for (std::uint32_t vertex = 1; vertex <= kMaxVertices && points.size() < kPoints; ++vertex) {
            const Hit hit = intersector.closest_hit(ray);
            if (!hit.found()) break;
            points.push_back(make_surface_point<FeatureSet{}>(scene, hit, -ray.direction));
            const Vec4f v = rng.draw(vertex, Purpose::Scatter);
            ray = spawn_ray(points.back(), lambert_sample(points.back(), {v.x, v.y}));
        }
    }
    return points;
}

struct Timing {
    double ns = 0.0;
    std::uint64_t checksum = 0;
};

/// One lookup per point by `find`; `stride` leaves points out, for searches that would take minutes.
template <class Find>
Timing time_lookups(const std::vector<SurfacePoint>& points, std::size_t stride, const Find& find) {
    Timing timing;
    const Stopwatch watch;
    for (std::size_t i = 0; i < points.size(); i += stride)
        timing.checksum += static_cast<std::uint64_t>(find(points[i])) * (i + 1);
    timing.ns = 1e9 * watch.seconds() / static_cast<double>((points.size() + stride - 1) / stride);
    return timing;
}

void describe(const HostVolumes& volumes, const std::vector<SurfacePoint>& points) {
    const VolumeGridView grid = grid_view(volumes.grid);
    std::size_t sides = 0, nodes = 0, lists = 0;
    for (const SurfacePoint& point : points) {
        const VolumePlace place = grid.place_of(point.primitive, point.front, point.position);
        if (place.kind() == VolumePlace::Kind::Node) ++sides;
        if (place.kind() != VolumePlace::Kind::Cell) continue;
        nodes += grid.cells[place.number()].has_nodes() ? 1u : 0u;
        lists += grid.cells[place.number()].has_list() ? 1u : 0u;
    }
    const auto share = [&](std::size_t count) {
        return 100.0 * static_cast<double>(count) / static_cast<double>(points.size());
    };
    std::printf(
        "  points: %.1f %% one volume for the side, %.1f %% up to three for a cell, %.1f %% a list, %.4f %% search "
        "the tree\n",
        share(sides), share(nodes), share(lists), share(points.size() - sides - nodes - lists));
}

std::size_t bytes_of(const HostVolumeGrid& grid) {
    return grid.sides.size() * sizeof(VolumePlace) + grid.grids.size() * sizeof(SideGrid) +
           grid.cells.size() * sizeof(VolumeCell) + grid.lists.size() * sizeof(std::uint32_t);
}

bool measure(const HostScene& scene, const std::vector<SurfacePoint>& points, int count, int rounds) {
    HostVolumes volumes = place_volumes(scene, {.volumes = count});
    std::vector<double> build, grid_ns, tree_ns, linear_ns, ratio;
    for (int i = 0; i < 3; ++i) {
        const Stopwatch watch;
        volumes.grid = build_volume_grid(scene, volumes, 2);
        build.push_back(watch.seconds());
    }
    const auto volumes_size = volumes.sites.size();
    const std::size_t bytes = bytes_of(volumes.grid);
    std::printf("%zu volumes: built in %.4f s with two threads, %.1f kB (%.0f bytes per volume), %zu grids\n",
                volumes_size, quartiles_of(build).median, 1e-3 * static_cast<double>(bytes),
                static_cast<double>(bytes) / static_cast<double>(volumes_size), volumes.grid.grids.size());
    describe(volumes, points);
    const std::size_t stride = 1 + volumes_size / 100;
    const KdTreeView nodes{view_of(std::as_const(volumes.kd_nodes))};
    const VolumeGridView sides = grid_view(volumes.grid);
    const auto by_grid = [&](const SurfacePoint& point) { return find_volume(nodes, sides, point).volume; };
    const auto by_tree = [&](const SurfacePoint& point) {
        return find_volume(nodes, point.position, point.geometric_normal);
    };
    const auto by_all = [&](const SurfacePoint& point) {
        return test::find_volume_by_all(nodes.nodes, point.position, point.geometric_normal);
    };
    bool same = time_lookups(points, stride, by_all).checksum == time_lookups(points, stride, by_grid).checksum;
    for (int i = 0; i < rounds; ++i) {
        const Timing grid = time_lookups(points, 1, by_grid);
        const Timing tree = time_lookups(points, 1, by_tree);
        same = same && grid.checksum == tree.checksum;
        grid_ns.push_back(grid.ns);
        tree_ns.push_back(tree.ns);
        linear_ns.push_back(time_lookups(points, stride, by_all).ns);
        ratio.push_back(tree.ns / grid.ns);
    }
    std::printf("  ns per lookup: grid %.1f, tree %.1f, linear %.1f; tree / grid %.2f [%.2f, %.2f]; %s\n",
                quartiles_of(grid_ns).median, quartiles_of(tree_ns).median, quartiles_of(linear_ns).median,
                quartiles_of(ratio).median, quartiles_of(ratio).lower, quartiles_of(ratio).upper,
                same ? "same answers" : "ANSWERS DIFFER");
    return same;
}

}  // namespace
}  // namespace pl::benchmarks

int main(int count, char** arguments) try {
    using namespace pl::benchmarks;
    const std::string name = count > 1 ? arguments[1] : "cornell";
    const int rounds = count > 2 ? std::max(1, std::atoi(arguments[2])) : 9;
    const pl::SceneDescription description = pl::load_scene(name, PL_SOURCE_DIR "/assets");
    const pl::HostScene scene = pl::pack_scene(description);
    const std::vector<pl::SurfacePoint> points =
        path_vertices(scene.view(), pl::make_camera(description.camera, kSide, kSide));
    std::printf("%s: %zu triangles, %zu points, %d rounds: medians [quartiles]\n", description.name.c_str(),
                scene.triangles.size(), points.size(), rounds);
    const MachineLoad load;
    bool same = true;
    for (const int volumes : {1000, 10000, 20000}) same = measure(scene, points, volumes, rounds) && same;
    const MachineLoad::Shares shares = load.shares();
    std::printf("processors busy: %.2f with this, %.2f with other work, %.2f stolen\n", shares.own, shares.foreign,
                shares.stolen);
    return same ? 0 : 1;
} catch (const pl::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
