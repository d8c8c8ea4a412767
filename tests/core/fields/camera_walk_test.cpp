// Volumes where paths from the camera arrive: the walk, the choice of sites among its points, and placements that need them.
#include "core/fields/camera_walk.h"

#include <algorithm>

#include "core/fields/place_volumes.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;

namespace {

SurfacePoint point_at(Vec3f position, Vec3f normal) {
    SurfacePoint point{};
    point.position = position;
    point.geometric_normal = normal;
    return point;
}

/// A ball of 6320 faces over a floor of ten thousand times its area.
SceneDescription ball_over_floor() {
    SceneDescription scene;
    scene.materials = {gray()};
    scene.environment = Vec3f{1.0f};
    const std::uint32_t a = add_vertex(scene, {-200, -2, -200});
    const std::uint32_t b = add_vertex(scene, {-200, -2, 200});
    const std::uint32_t c = add_vertex(scene, {200, -2, 200});
    const std::uint32_t d = add_vertex(scene, {200, -2, -200});
    add_quad(scene, a, b, c, d, 0);
    add_spiky_sphere(scene, 40, 80, 0.8f, 1.2f, 0);
    return scene;
}

Camera camera_at(float x) { return {.eye = {x, 0, 4}, .right = {0.5f, 0, 0}, .up = {0, 0.5f, 0}}; }

/// Share of the points that no volume serves.
double missed(const HostVolumes& volumes, const std::vector<SurfacePoint>& points) {
    const auto misses = std::ranges::count_if(points, [&](const SurfacePoint& point) {
        return find_volume({.nodes = view_of(volumes.kd_nodes)}, point.position, point.geometric_normal) == kNoVolume;
    });
    return static_cast<double>(misses) / static_cast<double>(points.size());
}

bool same_sites(const HostVolumes& a, const HostVolumes& b) {
    return std::ranges::equal(a.sites, b.sites, [](const SurfacePoint& p, const SurfacePoint& q) {
        return p.position == q.position && p.geometric_normal == q.geometric_normal;
    });
}

}  // namespace

// The points are seen by a camera a step to the side: no path of the placement.
TEST_CASE("Where sides outnumber volumes, volumes are placed where paths arrive") {
    const HostScene scene = pack_scene(ball_over_floor());
    const Camera camera = camera_at(0.0f);
    const std::vector<SurfacePoint> reached = walk_from_camera(scene, camera_at(0.1f));
    REQUIRE(reached.size() > 8192);
    const HostVolumes by_area = place_volumes(scene, FieldSettings{.volumes = 400});
    const HostVolumes by_paths = place_volumes(scene, FieldSettings{.volumes = 400}, &camera);
    CHECK(by_paths.sites.size() == 400);
    CHECK(by_paths.normals.size() == 400);
    CHECK(missed(by_area, reached) > 0.2);
    CHECK(missed(by_paths, reached) < 0.001);
}

TEST_CASE("With a volume for every side the camera changes no placement") {
    SceneDescription description;
    description.materials = {gray()};
    add_box(description, {-1, -1, -1}, {1, 1, 1}, true);
    const HostScene scene = pack_scene(description);
    const Camera camera = camera_at(0.0f);
    CHECK(same_sites(place_volumes(scene, FieldSettings{.volumes = 100}),
                     place_volumes(scene, FieldSettings{.volumes = 100}, &camera)));
}

TEST_CASE("A camera before nothing leaves the placement by area with fewer volumes") {
    const HostScene scene = pack_scene(ball_over_floor());
    Camera away = camera_at(0.0f);
    away.axis = away.center = {0, 0, 1};
    away.up = {0, 0.001f, 0};
    CHECK(walk_from_camera(scene, away).empty());
    CHECK(same_sites(place_volumes(scene, FieldSettings{.volumes = 400}, &away),
                     place_volumes(scene, FieldSettings{.volumes = 200})));
}

TEST_CASE("Placements by paths are reproducible and scale with the scene") {
    SceneDescription description = ball_over_floor();
    Camera camera = camera_at(0.0f);
    const HostVolumes first = place_volumes(pack_scene(description), FieldSettings{.volumes = 400}, &camera);
    for (const int threads : {1, 3}) {
        INFO(threads << " threads");
        CHECK(same_sites(first,
                         place_volumes(pack_scene(description), FieldSettings{.volumes = 400}, &camera, threads)));
    }
    transform(description, false, 1024.0f, Vec3f{0.0f});
    camera.eye *= 1024.0f;
    HostVolumes scaled = place_volumes(pack_scene(description), FieldSettings{.volumes = 400}, &camera);
    for (SurfacePoint& site : scaled.sites) site.position *= 1.0f / 1024.0f;
    CHECK(same_sites(first, scaled));
}

TEST_CASE("Sites share the points out equally") {
    std::vector<SurfacePoint> points;
    Uniforms random(1);
    for (int i = 0; i < 900; ++i) points.push_back(point_at(random.cube(0, 1), {0, 0, 1}));
    for (int i = 0; i < 100; ++i) points.push_back(point_at(random.cube(0, 1) + Vec3f{100, 0, 0}, {0, 0, 1}));
    const std::vector<SurfacePoint> sites = choose_sites(points, 100);
    REQUIRE(sites.size() == 100);
    const auto is_far = [](const SurfacePoint& site) { return site.position.x > 50.0f; };
    CHECK(std::abs(std::ranges::count_if(sites, is_far) - 10) <= 1);
    for (const SurfacePoint& site : sites)
        CHECK(std::ranges::any_of(points, [&](const SurfacePoint& p) { return p.position == site.position; }));
}

TEST_CASE("Points at one place with opposite normals get sites for both") {
    std::vector<SurfacePoint> points;
    for (int i = 0; i < 32; ++i) points.push_back(point_at(Vec3f{0.0f}, {0, 0, i % 2 == 0 ? 1.0f : -1.0f}));
    const std::vector<SurfacePoint> sites = choose_sites(points, 2);
    REQUIRE(sites.size() == 2);
    CHECK(sites[0].geometric_normal == -sites[1].geometric_normal);
}

TEST_CASE("Fewer points than sites are all taken") {
    CHECK(choose_sites({}, 5).empty());
    CHECK(choose_sites({point_at({1, 2, 3}, {0, 0, 1})}, 5).size() == 1);
    CHECK(choose_sites({point_at({1, 2, 3}, {0, 0, 1})}, 0).empty());
}
