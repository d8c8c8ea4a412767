// The surface point closest to a given point, and the side of it that the point lies on.
#include <random>

#include "app/closest_surface.h"
#include "core/scene/instances.h"
#include "tests/support/catch.hpp"

namespace pl {
namespace {

SceneDescription one_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    SceneDescription scene;
    scene.positions = {a, b, c};
    scene.materials.emplace_back();
    scene.triangles.push_back({.vertex = {0, 1, 2}});
    return scene;
}

}  // namespace

TEST_CASE("the closest surface point is the closest of a dense set of points") {
    // The sampled triangle has points every 1/200 of its edges, so that the true distance is at most half a step of the
    // longest edge (3 * sqrt(2) / 200 / 2) below the sampled one, and never above it.
    std::mt19937 random(11);
    std::uniform_real_distribution<float> coordinate(-2.0f, 2.0f);
    const glm::vec3 a(0, 0, 0), b(3, 0, 0), c(0, 3, 1);
    const SceneDescription scene = one_triangle(a, b, c);
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 point(coordinate(random), coordinate(random), coordinate(random));
        float sampled = 1.0e9f;
        for (int u = 0; u <= 200; ++u)
            for (int v = 0; u + v <= 200; ++v)
                sampled = std::min(sampled, glm::distance(point, a + (b - a) * (static_cast<float>(u) / 200.0f) +
                                                                     (c - a) * (static_cast<float>(v) / 200.0f)));
        const ClosestSurface surface = closest_surface(scene, point);
        REQUIRE(surface.distance <= sampled + 1.0e-5f);  // rounding of the sampled distance
        REQUIRE(surface.distance >= sampled - 0.0108f);
        REQUIRE(glm::distance(point, surface.position) == Approx(surface.distance).margin(1.0e-5));
        REQUIRE(glm::dot(point - a, surface.normal) >= 0.0f);
    }
}

TEST_CASE("the side of the closest surface is the one that the point lies on") {
    const SceneDescription scene = one_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    CHECK(closest_surface(scene, {0.2f, 0.2f, 5.0f}).normal.z == 1.0f);
    CHECK(closest_surface(scene, {0.2f, 0.2f, -5.0f}).normal.z == -1.0f);
    CHECK(closest_surface(scene, {0.2f, 0.2f, 0.0f}).normal.z == 1.0f);
    CHECK(closest_surface(scene, {0.2f, 0.2f, 5.0f}).distance == 5.0f);
}

TEST_CASE("the closest surface may be of an instance, whose side is that of its place") {
    std::mt19937 random(12);
    std::uniform_real_distribution<float> coordinate(-4.0f, 4.0f);
    SceneDescription scene = one_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    scene.positions.insert(scene.positions.end(), {{0, 0, 0.2f}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    for (const glm::uvec3& vertex : {glm::uvec3(3, 4, 5), glm::uvec3(3, 5, 6)})
        scene.triangles.push_back({.vertex = vertex});
    scene.meshes = {{"leaf", 1, 2}};
    for (int i = 0; i < 20; ++i) {
        glm::mat4x3 place(1.0f + 0.2f * std::abs(coordinate(random)));
        for (int axis = 0; axis < 3; ++axis) place[3][axis] = coordinate(random);
        place[1][0] = 0.3f;
        scene.instances.push_back({0, place});
    }
    SceneDescription copied = scene;
    expand_instances(copied);
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 point(coordinate(random), coordinate(random), coordinate(random));
        const ClosestSurface found = closest_surface(scene, point);
        const ClosestSurface expected = closest_surface(copied, point);
        REQUIRE(found.distance == Approx(expected.distance).margin(1e-5));
        REQUIRE(glm::distance(found.position, expected.position) < 1e-4f);
    }
}

}  // namespace pl
