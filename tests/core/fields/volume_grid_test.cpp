// Lookups in the grids on triangles equal a linear search, for every point that rays can hit, and for others.
#include "core/fields/volume_grid.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/fields/place_volumes.h"
#include "core/io/load_scene.h"
#include "core/kernel/geometry/intersector.h"
#include "core/kernel/shading/lambert.h"
#include "tests/support/catch.hpp"
#include "tests/support/field/linear_search.h"
#include "tests/support/rays/walk.h"

using namespace pl;
using namespace pl::test;

namespace {

struct Placed {
    HostScene scene;
    HostVolumes volumes;

    KdTreeView tree() const { return {view_of(volumes.kd_nodes)}; }
    std::int32_t by_grid(const SurfacePoint& point) const {
        const FoundVolume found = find_volume(tree(), grid_view(volumes.grid), point);
        if (found.node != FoundVolume::kUnknown)
            REQUIRE(static_cast<std::int32_t>(volumes.kd_nodes[found.node].volume) == found.volume);
        return found.volume;
    }
    std::int32_t by_all(const SurfacePoint& point) const {
        return find_volume_by_all(view_of(volumes.kd_nodes), point.position, point.geometric_normal);
    }
    VolumePlace place_of(const SurfacePoint& point) const {
        return grid_view(volumes.grid).place_of(point.primitive, point.front, point.position);
    }
    bool is_searched(const SurfacePoint& point) const {
        const VolumePlace place = place_of(point);
        if (place.kind() == VolumePlace::Kind::Cell) return volumes.grid.cells[place.number()].is_searched();
        return place.kind() == VolumePlace::Kind::Search;
    }
};

Placed with_grid(const SceneDescription& description, int volumes, int threads = 2) {
    Placed placed{pack_scene(description), {}};
    placed.volumes = place_volumes(placed.scene, {.volumes = volumes});
    placed.volumes.grid = build_volume_grid(placed.scene, placed.volumes, threads);
    return placed;
}

/// Volumes at points of the scene's own triangles, or at `sites`.
Placed with_sites(const SceneDescription& description, std::vector<SurfacePoint> sites) {
    Placed placed{pack_scene(description), {}};
    for (const SurfacePoint& site : sites) placed.volumes.normals.push_back(site.geometric_normal);
    placed.volumes.sites = std::move(sites);
    placed.volumes.kd_nodes = build_kd_tree(view_of(std::as_const(placed.volumes.sites)));
    placed.volumes.grid = build_volume_grid(placed.scene, placed.volumes, 2);
    return placed;
}

SurfacePoint on_triangle(const HostScene& scene, std::uint32_t primitive, Uniforms& random) {
    Hit hit{.primitive = primitive};
    if (random.below(3) == 0) {
        move_to_edge(hit, random);
    } else {
        const Vec2f b = square_to_triangle(random.square());
        hit.b1 = b.x;
        hit.b2 = b.y;
    }
    const Vec3f side = (random.below(2) == 0 ? 1.0f : -1.0f) * scene.planes[primitive].normal;
    // With the renderer's margin from the edges, and without.
    if (random.below(2) == 0) return make_surface_point<FeatureSet{}>(scene.view(), hit, side);
    return make_surface_point<FeatureSet{}>(scene.view(), primitive, {1.0f - hit.b1 - hit.b2, hit.b1, hit.b2}, side);
}

struct Tally {
    int wrong = 0;
    int searched = 0;  ///< answered by the tree
    int points = 0;
};

void compare(const Placed& placed, const SurfacePoint& point, Tally& tally) {
    ++tally.points;
    tally.wrong += placed.by_grid(point) == placed.by_all(point) ? 0 : 1;
    tally.searched += placed.is_searched(point) ? 1 : 0;
}

/// Points all over both sides of all triangles.
Tally compare_on_triangles(const Placed& placed, int points, std::uint64_t seed = 5) {
    Uniforms random(seed);
    Tally tally;
    const auto triangles = static_cast<std::uint32_t>(placed.scene.triangles.size());
    for (int i = 0; i < points; ++i)
        compare(placed, on_triangle(placed.scene, random.below(triangles), random), tally);
    return tally;
}

/// Points where diffuse paths from the scene's camera hit, every fourth moved next to an edge or a corner.
Tally compare_on_paths(const Placed& placed, const SceneDescription& description, int points) {
    const SceneView scene = placed.scene.view();
    const BvhIntersector intersector{scene};
    const Camera camera = make_camera(description.camera, 64, 64);
    Uniforms random(6);
    Tally tally;
    while (tally.points < points) {
        Ray ray = generate_ray(camera, 64.0f * random.square(), {64.0f, 64.0f});
        for (int vertex = 0; vertex < 8; ++vertex) {
            Hit hit = intersector.closest_hit(ray);
            if (!hit.found()) break;
            if (random.below(4) == 0) move_to_edge(hit, random);
            const SurfacePoint point = make_surface_point<FeatureSet{}>(scene, hit, -ray.direction);
            compare(placed, point, tally);
            ray = spawn_ray(point, lambert_sample(point, random.square()));
        }
    }
    return tally;
}

SceneDescription asset(const std::string& name) { return load_scene(name, PL_SOURCE_DIR "/assets"); }

bool same(const HostVolumeGrid& a, const HostVolumeGrid& b) {
    bool same = true;
    zip(a, b, [&](const auto& x, const auto& y) {
        same = same && x.size() == y.size() &&
               (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof x[0]) == 0);
    });
    return same;
}

std::size_t bytes_of(const HostVolumeGrid& grid) {
    std::size_t bytes = 0;
    zip(grid, grid, [&](const auto& x, const auto&) { bytes += x.size() * sizeof x[0]; });
    return bytes;
}

bool within_bounds(const Placed& placed) {
    return bytes_of(placed.volumes.grid) <=
           kGridBytesPerVolume * placed.volumes.sites.size() + kGridBytesPerTriangle * placed.scene.triangles.size();
}

/// A sphere of facets, fronts inwards.
SceneDescription ball(int rings, float low, float high) {
    SceneDescription scene;
    scene.materials.push_back(gray());
    scene.materials[0].emission = Vec3f{1.0f};
    add_spiky_sphere(scene, rings, 2 * rings, low, high, 3);
    return scene;
}

/// One square of edge 8 in the plane z = 0, as two triangles.
SceneDescription plate() {
    SceneDescription scene;
    scene.materials.push_back(gray());
    std::uint32_t corner[4];
    for (std::uint32_t i = 0; i < 4; ++i)
        corner[i] = add_vertex(scene, {i == 1 || i == 2 ? 8.0f : 0.0f, i > 1 ? 8.0f : 0.0f, 0.0f});
    add_quad(scene, corner[0], corner[1], corner[2], corner[3]);
    return scene;
}

SurfacePoint at(Vec3f position, std::uint32_t primitive, bool front = true) {
    SurfacePoint point;
    point.position = position;
    point.primitive = primitive;
    point.front = front;
    point.geometric_normal = {0.0f, 0.0f, front ? 1.0f : -1.0f};
    return point;
}

}  // namespace

TEST_CASE("Grids answer like a linear search in the scenes of the program") {
    for (const char* name : {"cornell", "door", "furnace"})
        for (const int volumes : {1, 30, 1000}) {
            CAPTURE(name, volumes);
            const SceneDescription description = asset(name);
            const Placed placed = with_grid(description, volumes);
            const Tally all = compare_on_triangles(placed, 20000);
            const Tally seen = compare_on_paths(placed, description, 20000);
            CHECK(all.wrong == 0);
            CHECK(seen.wrong == 0);
            CHECK(seen.searched < seen.points / 50);  // on lit surfaces hardly a lookup is left to the tree
            CHECK(within_bounds(placed));
        }
}

TEST_CASE("Grids answer like a linear search with 20000 volumes") {
    const SceneDescription description = asset("cornell");
    const Placed placed = with_grid(description, 20000);
    CHECK(compare_on_triangles(placed, 2000).wrong == 0);
    const Tally seen = compare_on_paths(placed, description, 4000);
    CHECK(seen.wrong == 0);
    CHECK(seen.searched < seen.points / 50);
    CHECK(within_bounds(placed));
}

TEST_CASE("Grids answer like a linear search on curved and ragged meshes") {
    for (const float low : {1.0f, 0.6f})
        for (const int rings : {8, 40})
            for (const int volumes : {100, 3000}) {
                CAPTURE(low, rings, volumes);
                SceneDescription description = ball(rings, low, 1.0f);
                transform(description, true, 3.0f, {10.0f, -200.0f, 0.5f});
                const Placed placed = with_grid(description, volumes);
                CHECK(compare_on_triangles(placed, 10000).wrong == 0);
                CHECK(within_bounds(placed));
            }
}

TEST_CASE("Grids answer like a linear search at every scale, far from the origin, and on slivers") {
    for (const float scale : {1e-18f, 1e-9f, 1.0f, 1e9f, 1e16f})
        for (const float away : {0.0f, 30.0f, 1e5f})
            for (const float thin : {1.0f, 1e-3f, 1e-6f}) {
                CAPTURE(scale, away, thin);
                SceneDescription description = plate();
                for (glm::vec3& p : description.positions) p = {p.x, p.y * thin, p.x * 0.25f};
                transform(description, true, scale, Vec3f{away * scale});
                HostScene scene = pack_scene(description);
                Uniforms random(7);
                std::vector<SurfacePoint> sites;
                for (int i = 0; i < 300; ++i) sites.push_back(on_triangle(scene, random.below(2), random));
                CHECK(compare_on_triangles(with_sites(description, sites), 5000).wrong == 0);
            }
}

TEST_CASE("Of volumes at the same distance grids answer the lowest number") {
    // On a lattice, numbered crosswise, each place once, or thrice by different numbers.
    for (const int copies : {1, 3}) {
        std::vector<SurfacePoint> sites;
        for (int i = 0; i < 81 * copies; ++i) {
            const int place = i * 37 % 81;
            const int x = place % 9;
            const int y = place / 9;
            sites.push_back(at({static_cast<float>(x), static_cast<float>(y), 0.0f}, x >= y ? 0 : 1));
        }
        const Placed placed = with_sites(plate(), sites);
        Tally tally;
        for (int x = 0; x <= 64; ++x)
            for (int y = 0; y <= 64; ++y) {
                const Vec3f p{0.125f * static_cast<float>(x), 0.125f * static_cast<float>(y), 0.0f};
                if (x >= y) compare(placed, at(p, 0), tally);
                if (x <= y) compare(placed, at(p, 1), tally);
            }
        CHECK(tally.wrong == 0);
        CHECK(tally.searched == 0);
        CHECK(compare_on_triangles(placed, 20000).wrong == 0);
    }
}

TEST_CASE("Both sides of a thin wall have volumes of their own") {
    Uniforms random(8);
    std::vector<SurfacePoint> sites;
    for (int i = 0; i < 400; ++i) {
        const Vec2f p = 8.0f * random.square();
        // Those above the wall are nearer than most on it, but their normals do not agree.
        sites.push_back(at({p.x, p.y, i % 3 == 0 ? 0.01f : 0.0f}, p.x >= p.y ? 0 : 1, i % 2 == 0));
        if (i % 3 == 0) sites.back().geometric_normal = {1.0f, 0.0f, 0.0f};
    }
    const Placed placed = with_sites(plate(), sites);
    const Tally tally = compare_on_triangles(placed, 20000);
    CHECK(tally.wrong == 0);
    CHECK(tally.searched == 0);
    int front = 0;
    for (int i = 0; i < 1000; ++i) {
        const SurfacePoint point = on_triangle(placed.scene, random.below(2), random);
        const std::int32_t volume = placed.by_grid(point);
        REQUIRE(volume != kNoVolume);
        CHECK(sites[static_cast<std::size_t>(volume)].front == point.front);
        front += point.front ? 1 : 0;
    }
    CHECK((front > 300 && front < 700));
}

TEST_CASE("Hostile volumes and triangles are answered like by a linear search, in bounded memory") {
    SceneDescription description = plate();
    add_triangle(description, Vec3f{1.0f}, Vec3f{1.0f}, Vec3f{1.0f});                          // a point
    add_triangle(description, Vec3f{0.0f}, Vec3f{1.0f}, Vec3f{2.0f});                          // a line
    add_triangle(description, Vec3f{1e-30f, 0, 0}, Vec3f{0, 1e-30f, 0}, Vec3f{0, 0, 1e-30f});  // nearly a point
    add_triangle(description, Vec3f{1e17f, 0, 0}, Vec3f{0, 1e17f, 0}, Vec3f{0, 0, 1});         // huge
    add_triangle(description, Vec3f{0, 0, 5}, Vec3f{8, 0, 5}, Vec3f{0, 1e-7f, 5});             // a sliver
    add_triangle(description, Vec3f{0, 0, -30}, Vec3f{1e-3f, 0, -30}, Vec3f{0, 1e-3f, -30});   // far from all
    Uniforms random(9);
    std::vector<SurfacePoint> sites;
    const auto add = [&](Vec3f p) { sites.push_back(at(p, random.below(2), random.below(8) != 0)); };
    for (int i = 0; i < 500; ++i) add({8.0f * random.next(), 8.0f * random.next(), 0.0f});
    for (int i = 0; i < 500; ++i) add({2.0f, 3.0f, 0.0f});
    for (int i = 0; i < 1000; ++i) add({5.0f + 1e-5f * random.next(), 3.0f + 1e-5f * random.next(), 0.0f});
    // The points of the last triangle are (nearly) in the middle of this ring.
    for (int i = 0; i < 300; ++i)
        add({4.0f * std::cos(static_cast<float>(i)), 4.0f * std::sin(static_cast<float>(i)), -30.0f});
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const Vec3f bad : {Vec3f{nan}, Vec3f{0.0f, kInfinity, 0.0f}, Vec3f{-kInfinity, nan, 0.0f}}) add(bad);
    Placed placed = with_sites(description, sites);
    CHECK_FALSE(placed.volumes.grid.sides.empty());
    CHECK(compare_on_triangles(placed, 20000).wrong == 0);
    CHECK(within_bounds(placed));

    // Beyond the range of finite squared distances every lookup searches the tree.
    add(Vec3f{1e19f, 0.0f, 0.0f});
    placed = with_sites(description, sites);
    CHECK(placed.volumes.grid.sides.empty());
    CHECK(compare_on_triangles(placed, 1000).wrong == 0);
    CHECK(placed.by_grid(at({2.0f, 3.0f, 0.0f}, kNoPrimitive)) == placed.by_all(at({2.0f, 3.0f, 0.0f}, 0)));
}

TEST_CASE("Points beside their triangle, not finite, or of no triangle are answered") {
    const Placed placed = with_grid(asset("cornell"), 1000);
    Uniforms random(10);
    for (int i = 0; i < 2000; ++i) {
        SurfacePoint point = on_triangle(placed.scene, random.below(32), random);
        const float nan = std::numeric_limits<float>::quiet_NaN();
        const int axis = static_cast<int>(random.below(3));
        point.position[axis] = i % 3 == 0 ? nan : (i % 3 == 1 ? kInfinity : -kInfinity);
        if (placed.place_of(point).kind() == VolumePlace::Kind::Node)
            continue;  // small sides do not look at the position
        REQUIRE(placed.by_grid(point) == kNoVolume);
    }
    SurfacePoint point = on_triangle(placed.scene, 0, random);
    point.primitive = kNoPrimitive;
    CHECK(placed.by_grid(point) == placed.by_all(point));
    CHECK(find_volume(placed.tree(), {}, point).volume == placed.by_all(point));
}

TEST_CASE("Without volumes grids find none") {
    const Placed placed = with_sites(plate(), {});
    CHECK(placed.by_grid(at({1, 0.5f, 0}, 0)) == kNoVolume);
    CHECK(placed.place_of(at({1, 0.5f, 0}, 0)).kind() == VolumePlace::Kind::Node);
    CHECK(build_volume_grid(pack_scene(SceneDescription{}), {}, 2).sides.empty());
}

// Light comes from outside of the ball: the inner sides of its triangles stay dark.
TEST_CASE("Sides that no light reaches are searched, and answered alike") {
    SceneDescription description = ball(20, 0.8f, 1.0f);
    description.environment = Vec3f{1.0f};
    Placed placed = with_grid(description, 500);
    const HostVolumeGrid whole = placed.volumes.grid;
    const LitSurfaces surfaces = find_lit_surfaces(placed.scene, 2);
    placed.volumes.grid = build_volume_grid(placed.scene, placed.volumes, 2, &surfaces);
    CHECK(compare_on_triangles(placed, 10000).wrong == 0);
    const auto triangles = static_cast<std::uint32_t>(placed.scene.planes.size());
    const auto is_searched = [](const HostVolumeGrid& grid, std::uint32_t side) {
        return grid.sides[side].kind() == VolumePlace::Kind::Search;
    };
    std::uint32_t dark = 0;
    for (std::uint32_t side = 0; side < 2 * triangles; ++side) {
        const bool is_lit = surfaces.is_lit(side % triangles, side < triangles);
        CHECK(is_searched(placed.volumes.grid, side) == (!is_lit || is_searched(whole, side)));
        dark += !is_lit && !is_searched(whole, side) ? 1u : 0u;
    }
    CHECK(dark > triangles / 3);  // a grid of all sides has these
    CHECK(placed.volumes.grid.cells.size() < whole.cells.size());
}

TEST_CASE("Grids do not depend on the number of threads") {
    const SceneDescription description = ball(20, 0.8f, 1.0f);
    const Placed one = with_grid(description, 2000, 1);
    CHECK_FALSE(one.volumes.grid.grids.empty());
    CHECK_FALSE(one.volumes.grid.lists.empty());
    for (const int threads : {0, 2, 7})
        CHECK(same(one.volumes.grid, with_grid(description, 2000, threads).volumes.grid));
}

TEST_CASE("Cells keep their entries") {
    const VolumeCell three{0, VolumeCell::kMaxNode, 7};
    CHECK((three.has_nodes() && !three.has_list() && !three.is_searched()));
    CHECK(three.node(0) == 0);
    CHECK(three.node(1) == VolumeCell::kMaxNode);
    CHECK(three.node(2) == 7);
    const VolumeCell most{VolumeCell::kMaxNode, VolumeCell::kMaxNode, VolumeCell::kMaxNode};
    CHECK((most.has_nodes() && !most.is_searched()));
    for (const std::uint32_t first : {0u, 0xfffffffeu}) {
        const VolumeCell list = VolumeCell::list(first);
        CHECK((list.has_list() && !list.has_nodes() && !list.is_searched()));
        CHECK(list.first_of_list() == first);
    }
    CHECK((VolumeCell{}.is_searched() && !VolumeCell{}.has_nodes() && !VolumeCell{}.has_list()));
}

TEST_CASE("Nearly every node of a cell and entry of a list is needed, and missed when it is not there") {
    Uniforms random(12);
    std::vector<SurfacePoint> sites;
    for (int i = 0; i < 40; ++i) {
        const Vec2f p = 8.0f * random.square();
        sites.push_back(at({p.x, p.y, 0.0f}, p.x >= p.y ? 0 : 1));
    }
    Placed placed = with_sites(plate(), sites);
    const HostVolumeGrid good = placed.volumes.grid;
    CHECK(compare_on_triangles(placed, 20000, 11).wrong == 0);
    // An entry goes missing where it is replaced by the one behind it.
    int noticed = 0;
    int tried = 0;
    for (std::uint32_t i = 0; i + 1 < good.lists.size(); ++i) {
        if ((good.lists[i] & kLastOfList) != 0) continue;
        placed.volumes.grid = good;
        placed.volumes.grid.lists[i] = good.lists[i + 1] & ~kLastOfList;
        ++tried;
        noticed += compare_on_triangles(placed, 20000, 11).wrong > 0 ? 1 : 0;
    }
    CHECK(tried > 30);
    CHECK(noticed > tried * 3 / 4);  // only the cells around a corner have lists, and some entries serve a tiny part

    // A node goes missing where it is replaced by another one of its cell.
    noticed = tried = 0;
    for (std::uint32_t i = 0; i < good.cells.size(); i += 2) {
        const VolumeCell cell = good.cells[i];
        if (!cell.has_nodes() || cell.node(0) == cell.node(2)) continue;
        placed.volumes.grid = good;
        placed.volumes.grid.cells[i] = {cell.node(1), cell.node(1), cell.node(2)};
        if (cell.node(1) == cell.node(2)) placed.volumes.grid.cells[i] = {cell.node(2), cell.node(2), cell.node(2)};
        ++tried;
        noticed += compare_on_triangles(placed, 20000, 11).wrong > 0 ? 1 : 0;
    }
    CHECK(tried > 50);
    CHECK(noticed > tried * 4 / 5);
}
