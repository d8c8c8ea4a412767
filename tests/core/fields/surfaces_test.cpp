// Surfaces: triangles that are joined, triangles that are not, and that any volume on a surface may serve all of it.
#include "core/fields/surfaces.h"

#include <algorithm>

#include "core/kernel/guiding/volume_lookup.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;

namespace {

std::vector<double> areas_of(const Surfaces& surfaces) {
    std::vector<double> areas;
    for (const Surface& surface : surfaces.list) areas.push_back(surface.area);
    return areas;
}

}  // namespace

TEST_CASE("A box has six surfaces and a sphere a few dozen") {
    SceneDescription box;
    box.materials.push_back(gray());
    add_box(box, Vec3f{-1}, {1, 2, 3}, true);
    const HostScene packed_box = pack_scene(box);
    const Surfaces six = find_surfaces(packed_box);
    CHECK(six.list.size() == 6);
    std::vector<double> areas = areas_of(six);
    std::sort(areas.begin(), areas.end());
    CHECK(areas == std::vector<double>{6, 6, 8, 8, 12, 12});

    SceneDescription sphere;
    sphere.materials.push_back(gray());
    add_spiky_sphere(sphere, 100, 100, 1.0f, 1.0f, 1);
    const Surfaces patches = find_surfaces(pack_scene(sphere));
    CHECK(patches.list.size() > 20);
    CHECK(patches.list.size() < 200);
}

TEST_CASE("Surfaces are joined at equal corners written twice and end where nothing reflects") {
    SceneDescription scene;
    scene.materials = {gray(), gray(0.0f)};
    add_triangle(scene, Vec3f{0, 0, 0}, Vec3f{1, 0, 0}, Vec3f{0, 1, 0});
    add_triangle(scene, Vec3f{1, 0, -0.0f}, Vec3f{1, 1, 0}, Vec3f{0, 1, 0});    // shares an edge, -0 is 0
    add_triangle(scene, Vec3f{1, 1, 0}, Vec3f{2, 1, 0}, Vec3f{1, 2, 0});        // shares a corner
    add_triangle(scene, Vec3f{5, 5, 0}, Vec3f{6, 5, 0}, Vec3f{5, 6, 0});        // shares nothing
    add_triangle(scene, Vec3f{0, 0, 0}, Vec3f{0, 1, 0}, Vec3f{1, 0, 0});        // faces the other way
    add_triangle(scene, Vec3f{1, 0, 0}, Vec3f{2, 0, 0}, Vec3f{1, 1, 0}, 1);     // reflects nothing
    add_triangle(scene, Vec3f{0, 0, 0}, Vec3f{1, 1, 0}, Vec3f{0.5f, 0.5f, 0});  // has no area
    const Surfaces surfaces = find_surfaces(pack_scene(scene));
    REQUIRE(surfaces.list.size() == 3);
    CHECK(surfaces.of_triangle == std::vector<std::uint32_t>{0, 0, 0, 1, 2, kNoSurface, kNoSurface});
    CHECK(surfaces.list[0].area == 1.5);
}

TEST_CASE("A surface that blends reflects if a material of the chain does") {
    SceneDescription scene;
    scene.materials = {gray(0.0f), gray(0.0f), gray(0.5f)};
    add_triangle(scene, Vec3f{0, 0, 0}, Vec3f{1, 0, 0}, Vec3f{0, 1, 0});
    CHECK(find_surfaces(pack_scene(scene)).list.empty());
    scene.materials[0].blend = {.other = 1};
    CHECK(find_surfaces(pack_scene(scene)).list.empty());
    scene.materials[1].blend = {.other = 2};
    CHECK(find_surfaces(pack_scene(scene)).list.size() == 1);
}

TEST_CASE("Any volume of a surface may serve any of its points") {
    SceneDescription description;
    description.materials.push_back(gray());
    add_spiky_sphere(description, 40, 40, 1.0f, 1.02f, 1);
    const HostScene scene = pack_scene(description);
    for (const Surface& surface : find_surfaces(scene).list)
        for (const std::uint32_t a : surface.triangles)
            for (const std::uint32_t b : surface.triangles)
                REQUIRE(normals_agree(scene.planes[a].normal, scene.planes[b].normal));
}

TEST_CASE("A fan of many triangles around one point is found quickly") {
    SceneDescription description;
    description.materials.push_back(gray());
    constexpr std::uint32_t kTriangles = 50000;
    add_vertex(description, Vec3f{0});
    for (std::uint32_t i = 0; i < kTriangles; ++i) {
        const double angle = 6.283185307179586 * i / kTriangles;
        add_vertex(description, Vec3f{Vec3d{std::cos(angle), std::sin(angle), 0.0}});
    }
    for (std::uint32_t i = 0; i < kTriangles; ++i) add_triangle(description, 0, 1 + i, 1 + (i + 1) % kTriangles);
    CHECK(find_surfaces(pack_scene(description)).list.size() == 1);
}
