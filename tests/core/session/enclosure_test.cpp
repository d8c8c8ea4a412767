// Points inside and outside of closed surfaces: borders, parity, and shapes made of quads.
#include "core/scene/enclosure.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/closed_scenes.h"
#include "tests/support/scenes/shipped_scenes.h"

using namespace pl;
using namespace pl::test;

namespace {

SceneDescription room(glm::vec3 low, glm::vec3 high) { return box_scene({}, low, high); }

SceneDescription joined(SceneDescription a, const SceneDescription& b) {
    const auto vertices = static_cast<std::uint32_t>(a.positions.size());
    a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
    for (TriangleDescription triangle : b.triangles) {
        triangle.vertex += vertices;
        a.triangles.push_back(triangle);
    }
    return a;
}

/// Every triangle with corners of its own.
SceneDescription in_pieces(const SceneDescription& scene) {
    SceneDescription result = scene;
    result.positions.clear();
    for (TriangleDescription& triangle : result.triangles)
        for (int corner = 0; corner < 3; ++corner) {
            result.positions.push_back(scene.positions[triangle.vertex[corner]]);
            triangle.vertex[corner] = static_cast<std::uint32_t>(result.positions.size()) - 1;
        }
    return result;
}

}  // namespace

TEST_CASE("Enclosure: inside a box is inside, however its corners are numbered") {
    const SceneDescription box = room({-1, -2, -3}, {1, 2, 3});
    for (const SceneDescription& scene : {box, in_pieces(box)}) {
        const Enclosure enclosure(scene);
        CHECK(enclosure.contains({0.0f, 0.0f, 0.0f}));
        CHECK(enclosure.contains({0.999f, -1.999f, 2.999f}));
        for (const glm::vec3 outside : {glm::vec3{1.001f, 0, 0}, {0, -2.001f, 0}, {0, 0, 1e30f}, {kNan, 0, 0}})
            CHECK_FALSE(enclosure.contains(outside));
    }
}

TEST_CASE("Enclosure: a border anywhere is a way out") {
    const SceneDescription box = room(glm::vec3{0.0f}, glm::vec3{1.0f});
    for (std::size_t missing = 0; missing < box.triangles.size(); ++missing) {
        SceneDescription open = box;
        open.triangles.erase(open.triangles.begin() + static_cast<std::ptrdiff_t>(missing));
        CHECK_FALSE(Enclosure(open).contains(glm::vec3{0.5f}));
    }
    SceneDescription cracked = in_pieces(box);
    cracked.positions[0].x += 1e-6f;
    CHECK_FALSE(Enclosure(cracked).contains(glm::vec3{0.5f}));
}

TEST_CASE("Enclosure: light passes through glass and holes, and triangles without area change nothing") {
    SceneDescription box = room(glm::vec3{0.0f}, glm::vec3{1.0f});
    box.triangles.push_back({.vertex = {0, 0, 1}});
    CHECK(Enclosure(box).contains(glm::vec3{0.5f}));
    SceneDescription window = box;
    window.materials[kWallX0].kind = SurfaceKind::Dielectric;
    CHECK_FALSE(Enclosure(window).contains(glm::vec3{0.5f}));
    SceneDescription part = box;
    part.materials.push_back({.name = "pane", .kind = SurfaceKind::Pane});
    part.materials[kWallX0].blend = {.other = static_cast<std::uint32_t>(part.materials.size() - 1)};
    CHECK_FALSE(Enclosure(part).contains(glm::vec3{0.5f}));
    SceneDescription net = box;
    net.materials[kWallX0].textures.opacity = 0;
    CHECK_FALSE(Enclosure(net).contains(glm::vec3{0.5f}));
    SceneDescription veil = box;
    veil.materials[kWallX0].opacity = 0.5f;
    CHECK_FALSE(Enclosure(veil).contains(glm::vec3{0.5f}));
}

TEST_CASE("Enclosure: each surface counts alone, and one that is open does not spoil another") {
    // Thick walls: the inside is within two surfaces. A lamp is a quad of its own.
    SceneDescription shells = joined(room(glm::vec3{0.0f}, glm::vec3{4.0f}), room(glm::vec3{1.0f}, glm::vec3{3.0f}));
    SceneDescription lamp = room({1.5f, 2.0f, 1.5f}, {2.5f, 2.0f, 2.5f});
    lamp.triangles.resize(2);
    shells = joined(shells, lamp);
    const Enclosure enclosure(shells);
    CHECK(enclosure.contains(glm::vec3{2.0f, 1.5f, 2.0f}));
    CHECK(enclosure.contains(glm::vec3{0.5f}));
    CHECK_FALSE(enclosure.contains(glm::vec3{-0.5f}));
}

TEST_CASE("Enclosure: an empty scene encloses no point") {
    CHECK_FALSE(Enclosure(SceneDescription{}).contains(glm::vec3{0.0f}));
}

TEST_CASE("Enclosure: of the shipped scenes the rooms are closed, and boxes without a front are not") {
    for (const char* name : {"furnace", "door"}) {
        const SceneDescription scene = shipped_scene(name);
        INFO(name);
        CHECK(Enclosure(scene).contains(scene.camera.eye));
    }
    for (const char* name : {"cornell", "open-box", "sky", "spheres"}) {
        const SceneDescription scene = shipped_scene(name);
        INFO(name);
        CHECK_FALSE(Enclosure(scene).contains(scene.camera.eye));
    }
}
