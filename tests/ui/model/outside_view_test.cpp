// A camera that has left the room is told from one that looks into it.
#include "ui/model/outside_view.h"

#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shipped_scenes.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

bool is_outside(const SceneDescription& scene, const CameraDescription& camera) {
    return looks_outside(pack_scene(scene), camera, 96, 64);
}

bool is_outside_from(const SceneDescription& scene, glm::vec3 eye, glm::vec3 target) {
    CameraDescription camera = scene.camera;
    camera.eye = eye;
    camera.target = target;
    return is_outside(scene, camera);
}

}  // namespace

TEST_CASE("Outside view: rooms are looked into, also through an open front, and from behind a wall they are not") {
    for (const char* name : {"cornell", "door", "boxed-lights", "shelter", "labyrinth", "staircase", "plates"})
        CHECK_FALSE(is_outside(shipped_scene(name), shipped_scene(name).camera));
    const SceneDescription cornell = shipped_scene("cornell");
    CHECK(is_outside_from(cornell, {278.0f, 273.0f, 1600.0f}, {278.0f, 273.0f, 0.0f}));
    CHECK(is_outside_from(cornell, {278.0f, 273.0f, -800.0f}, {278.0f, 273.0f, -1600.0f}));
    const SceneDescription room = shipped_scene("door");
    const glm::vec3 back = room.camera.eye - room.camera.target;
    CHECK(is_outside_from(room, room.camera.eye + 3.0f * back, room.camera.target));
}

TEST_CASE("Outside view: light from far away reaches every surface") {
    SceneDescription scene = shipped_scene("cornell");
    scene.environment = glm::vec3{1.0f};
    CHECK_FALSE(is_outside_from(scene, {278.0f, 273.0f, 1600.0f}, {278.0f, 273.0f, 0.0f}));
}
