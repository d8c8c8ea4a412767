#include "core/session/session_scene.h"

#include "core/base/error.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/closed_scenes.h"

using namespace pl;
using namespace pl::test;

namespace {

SessionScene furnace() { return SessionScene(std::make_shared<const SceneDescription>(furnace_scene(0.5f, 0.5f))); }

}  // namespace

TEST_CASE("Session scene: closed surfaces are looked for when a path has escaped, once per camera") {
    SessionScene scene = furnace();
    CHECK_FALSE(scene.knows_whether_closed());
    CHECK_FALSE(scene.is_closed());
    const glm::vec3 inside = scene.description()->camera.eye;
    scene.note_escape(inside, false);  // a small scene is tested at once
    REQUIRE(scene.knows_whether_closed());
    const bool is_closed = scene.is_closed();
    scene.note_escape(glm::vec3{1.0e6f}, true);
    CHECK(scene.is_closed() == is_closed);
    scene.forget_whether_closed();
    CHECK_FALSE(scene.knows_whether_closed());
    scene.note_escape(glm::vec3{1.0e6f}, true);
    CHECK(scene.knows_whether_closed());
    CHECK_FALSE(scene.is_closed());
}

TEST_CASE("Session scene: another material makes another scene and leaves the first one alone") {
    const SessionScene scene = furnace();
    MaterialDescription material = scene.description()->materials[0];
    material.albedo *= 0.5f;
    const SessionScene changed = scene.with_material(0, material);
    CHECK(changed.description() != scene.description());
    CHECK(changed.packed() != scene.packed());
    CHECK(changed.description()->materials[0].albedo == material.albedo);
    CHECK(scene.description()->materials[0].albedo != material.albedo);
    CHECK(changed.build_seconds() == scene.build_seconds());
    CHECK_THROWS_AS(scene.with_material(1000, material), Error);
}
