// The vertical axis: the guess for models of either custom, and the axes by name.
#include "core/scene/up_axis.h"

#include <algorithm>

#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;

namespace {

const Vec3f kX{1.0f, 0.0f, 0.0f};
const Vec3f kY{0.0f, 1.0f, 0.0f};
const Vec3f kZ{0.0f, 0.0f, 1.0f};

/// A model of +y, turned so that +z is up.
SceneDescription lifted(SceneDescription scene) {
    for (glm::vec3& p : scene.positions) p = {p.x, -p.z, p.y};
    return scene;
}

SceneDescription moved(SceneDescription scene, Vec3f by, float scale = 1.0f) {
    for (glm::vec3& p : scene.positions) p = scale * (p + by);
    return scene;
}

/// Four legs and a top, y up, on the origin.
SceneDescription table() {
    SceneDescription scene;
    scene.materials = {gray()};
    for (const float x : {-0.8f, 0.7f})
        for (const float z : {-0.5f, 0.4f}) add_box(scene, {x, 0.0f, z}, {x + 0.1f, 0.7f, z + 0.1f}, false);
    add_box(scene, {-0.8f, 0.7f, -0.5f}, {0.8f, 0.75f, 0.5f}, false);
    return scene;
}

/// A tall and broad, thin figure on the origin, y up: the largest area faces the front.
SceneDescription figure() {
    SceneDescription scene;
    scene.materials = {gray()};
    add_box(scene, {-0.3f, 0.0f, -0.1f}, {0.3f, 1.8f, 0.1f}, false);
    return scene;
}

/// Height field over [0, 40]^2, y up, with slopes of up to 45 degrees.
SceneDescription terrain() {
    SceneDescription scene;
    scene.materials = {gray()};
    constexpr std::uint32_t kSide = 41;
    for (std::uint32_t i = 0; i < kSide; ++i)
        for (std::uint32_t j = 0; j < kSide; ++j) {
            const auto x = static_cast<float>(i);
            const auto z = static_cast<float>(j);
            add_vertex(scene, {x, 2.0f * std::sin(0.5f * x) * std::cos(0.4f * z), z});
        }
    for (std::uint32_t i = 0; i + 1 < kSide; ++i)
        for (std::uint32_t j = 0; j + 1 < kSide; ++j)
            add_quad(scene, i * kSide + j, i * kSide + j + 1, (i + 1) * kSide + j + 1, (i + 1) * kSide + j);
    return scene;
}

SceneDescription room() {
    SceneDescription scene;
    scene.materials = {gray()};
    add_box(scene, {0.0f, 0.0f, 0.0f}, {5.0f, 2.7f, 4.0f}, true);
    return scene;
}

}  // namespace

TEST_CASE("A model that stands on the origin is upright, whatever its shape and size") {
    for (const SceneDescription& model : {table(), figure()})
        for (const float scale : {1e-6f, 1.0f, 1e6f}) {
            CHECK(guess_up(moved(model, Vec3f{0.0f}, scale)) == kY);
            CHECK(guess_up(lifted(moved(model, Vec3f{0.0f}, scale))) == kZ);
            // Not quite on the plane, and not quite in the middle.
            CHECK(guess_up(lifted(moved(model, {0.04f, -0.03f, 0.0f}, scale))) == kZ);
        }
}

TEST_CASE("A model elsewhere is upright by its largest area, if it is as clear as that of a table or a terrain") {
    const Vec3f elsewhere{3.0f, 7.0f, -4.0f};
    CHECK(guess_up(lifted(moved(table(), elsewhere))) == kZ);
    CHECK(guess_up(moved(table(), elsewhere)) == kY);
    CHECK(guess_up(lifted(terrain())) == kZ);
    CHECK(guess_up(terrain()) == kY);
    // Walls and floor do not tell: the custom of OBJ files decides.
    CHECK(guess_up(room()) == kY);
    SceneDescription cube;
    cube.materials = {gray()};
    add_box(cube, {1.0f, 1.0f, 1.0f}, {2.0f, 2.0f, 2.0f}, false);
    CHECK(guess_up(cube) == kY);
}

TEST_CASE("A plane lies on the ground") {
    SceneDescription floor;
    floor.materials = {gray()};
    for (const Vec3f p : {Vec3f(-1, 0, -1), Vec3f(-1, 0, 1), Vec3f(1, 0, 1), Vec3f(1, 0, -1)}) add_vertex(floor, p);
    add_quad(floor, 0, 1, 2, 3);
    CHECK(guess_up(floor) == kY);
    CHECK(guess_up(lifted(floor)) == kZ);
}

TEST_CASE("Names of vertical axes, and the direction of each") {
    CHECK(choice_named<UpAxis>("auto") == UpAxis::Auto);
    CHECK(choice_named<UpAxis>("z") == UpAxis::Z);
    CHECK_FALSE(choice_named<UpAxis>("Z").has_value());
    CHECK_FALSE(choice_named<UpAxis>("").has_value());
    const SceneDescription upright = table();
    CHECK(up_direction(UpAxis::Auto, upright) == kY);
    CHECK(up_direction(UpAxis::Auto, lifted(upright)) == kZ);
    CHECK(up_direction(UpAxis::X, upright) == kX);
    CHECK(up_direction(UpAxis::Y, lifted(upright)) == kY);
    CHECK(up_direction(UpAxis::Z, upright) == kZ);
}

TEST_CASE("The axis nearest to a direction keeps its sign") {
    CHECK(nearest_axis({0.1f, 2.0f, -1.0f}) == kY);
    CHECK(nearest_axis({0.1f, 2.0f, -3.0f}) == -kZ);
    CHECK(nearest_axis({-0.2f, 0.0f, 0.1f}) == -kX);
}

TEST_CASE("The front of a model is perpendicular to its vertical axis, and turns over with it") {
    CHECK(front_of(kY) == kZ);
    CHECK(front_of(kZ) == -kY);
    CHECK(front_of(kX) == kZ);
    for (const Vec3f up : {kX, kY, kZ}) {
        CHECK(glm::dot(front_of(up), up) == 0.0f);
        CHECK(front_of(-up) == -front_of(up));
    }
}
