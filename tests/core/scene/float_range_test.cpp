// Scenes are moved and scaled to where floats resolve them, exactly; and what stays unresolved is named.
#include "core/scene/float_range.h"

#include "core/scene/scene_hash.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;

namespace {

/// A box with all that has a length, the size of a hand.
SceneDescription box_with_lights() {
    SceneDescription scene;
    scene.materials = {gray(), {.name = "glass", .kind = SurfaceKind::Dielectric, .absorption = {0.5f, 3.0f, 7.0f}}};
    add_box(scene, {-0.25f, -0.125f, -0.5f}, {0.25f, 0.125f, 0.5f}, true);
    add_box(scene, {-0.0625f, 0.0f, 0.0f}, {0.0f, 0.0625f, 0.03125f}, false, 1);
    scene.camera = {.eye = {0.1875f, 0.0f, 0.25f},
                    .target = {0.0f, 0.0625f, 0.0f},
                    .aperture_radius = 0.03125f,
                    .focus_distance = 0.375f};
    scene.cameras = {{"first", scene.camera, 0.0f}};
    scene.punctual_lights = {{.position = {0.125f, 0.0625f, 0.0f}, .intensity = {1, 2, 3}},
                             {.kind = PunctualKind::Spot, .position = {0, 0.0625f, 0}, .intensity = {4, 5, 6}},
                             {.kind = PunctualKind::Directional, .intensity = {7, 8, 9}}};
    return scene;
}

/// The box as a mesh that is shown twice.
SceneDescription with_instances(SceneDescription scene) {
    const auto first = static_cast<std::uint32_t>(scene.triangles.size());
    add_box(scene, {-0.03125f, -0.03125f, 0.0f}, {0.0f, 0.0f, 0.03125f}, false);
    scene.meshes = {{"box", first, 12}};
    glm::mat4x3 place(0.5f);
    place[3] = {0.125f, -0.0625f, 0.25f};
    scene.instances = {{0, place}, {0, place}};
    scene.instances[1].to_world[3].x = -0.125f;
    return scene;
}

void move(SceneDescription& scene, const glm::vec3& by) {
    const std::size_t of_mesh = scene.meshes.empty() ? 0 : 8;
    for (std::size_t i = 0; i + of_mesh < scene.positions.size(); ++i) scene.positions[i] += by;
    for (InstanceDescription& instance : scene.instances) instance.to_world[3] += by;
    for (CameraDescription* camera : {&scene.camera, &scene.cameras[0].camera}) {
        camera->eye += by;
        camera->target += by;
    }
    for (PunctualLightDescription& light : scene.punctual_lights) light.position += by;
}

void scale(SceneDescription& scene, float by) {
    for (glm::vec3& position : scene.positions) position *= by;
    for (InstanceDescription& instance : scene.instances) instance.to_world[3] *= by;
    for (CameraDescription* camera : {&scene.camera, &scene.cameras[0].camera}) {
        camera->eye *= by;
        camera->target *= by;
        camera->aperture_radius *= by;
        camera->focus_distance *= by;
    }
    for (PunctualLightDescription& light : scene.punctual_lights) light.position *= by;
    for (std::size_t i = 0; i < 2; ++i) scene.punctual_lights[i].intensity *= by * by;
    scene.materials[1].absorption /= by;
}

std::string last_warning(const SceneDescription& scene) {
    return scene.warnings.empty() ? "" : scene.warnings.back();
}

std::string warning_of_steps(SceneDescription scene) {
    warn_of_float_steps(scene);
    return last_warning(scene);
}

void check_equal(const SceneDescription& a, const SceneDescription& b) {
    CHECK(scene_hash(a) == scene_hash(b));
    CHECK(a.camera.eye == b.camera.eye);
    CHECK(a.camera.target == b.camera.target);
    CHECK(a.camera.aperture_radius == b.camera.aperture_radius);
    CHECK(a.camera.focus_distance == b.camera.focus_distance);
    CHECK(a.cameras[0].camera.eye == b.cameras[0].camera.eye);
}

}  // namespace

TEST_CASE("Scenes of usual sizes and places stay as they are, to the bit") {
    for (const float size : {0.01f, 1.0f, 1e6f, 1e7f})
        for (const float place : {0.0f, 1.0f, 30.0f}) {
            SceneDescription scene = with_instances(box_with_lights());
            move(scene, {place, 0.0f, -place});
            scale(scene, size);
            const SceneDescription before = scene;
            move_into_float_range(scene);
            warn_of_float_steps(scene);
            check_equal(scene, before);
            CHECK(scene.origin == glm::dvec3(0.0));
            CHECK(scene.warnings.empty());
        }
}

TEST_CASE("A scene far from the origin is moved to it, exactly, along the axes that are far") {
    for (const bool has_instances : {false, true}) {
        const SceneDescription near = has_instances ? with_instances(box_with_lights()) : box_with_lights();
        for (const glm::vec3& by :
             {glm::vec3{65536.0f, 0.0f, 0.0f}, {-262144.0f, 131072.0f, 1.0f}, {0.0f, 0.0f, 100.0f}}) {
            SceneDescription scene = near;
            move(scene, by);
            move_into_float_range(scene);
            SceneDescription expected = near;
            move(expected, {0.0f, 0.0f, by.z == 1.0f ? 1.0f : 0.0f});
            check_equal(scene, expected);
            CHECK(scene.origin == glm::dvec3(by.x, by.y, by.z == 1.0f ? 0.0f : by.z));
            CHECK_THAT(last_warning(scene), Catch::Contains("far from the origin, moved by"));
        }
    }
}

TEST_CASE("A huge or a tiny scene is scaled to about 1 by a power of two, with all its lengths") {
    for (const int exponent : {-60, -40, -12, 33, 40, 57}) {
        SceneDescription scene = with_instances(box_with_lights());
        const SceneDescription near = scene;
        scale(scene, std::ldexp(1.0f, exponent));
        INFO("times 2^" << exponent);
        move_into_float_range(scene);
        CHECK_THAT(last_warning(scene), Catch::Contains("lengths times 2^" + std::to_string(1 - exponent)));
        SceneDescription expected = near;
        scale(expected, 2.0f);
        check_equal(scene, expected);
    }
}

TEST_CASE("A scene that is both huge and far is moved and scaled") {
    SceneDescription scene = box_with_lights();
    move(scene, {4096.0f, 0.0f, 0.0f});
    scale(scene, 0x1p40f);
    move_into_float_range(scene);
    CHECK(scene.warnings.size() == 3);
    CHECK_THAT(last_warning(scene), Catch::Contains("lengths times 2^-39"));
    CHECK(scene.origin == glm::dvec3(8192.0, 0.0, 0.0));
    SceneDescription expected = box_with_lights();
    scale(expected, 2.0f);
    check_equal(scene, expected);
}

TEST_CASE("Surfaces of few steps of floats are named, but for those that are part of a larger one") {
    SceneDescription scene;
    scene.materials = {gray()};
    add_box(scene, glm::vec3(-1e6f), glm::vec3(1e6f), true);
    CHECK(warning_of_steps(scene).empty());
    SceneDescription with_box = scene;
    add_box(with_box, glm::vec3(9e5f), glm::vec3(9e5f + 2.0f), true);
    CHECK_THAT(warning_of_steps(with_box),
               Catch::Contains("1 surfaces are too small") && Catch::Contains("2 wide at 900002"));
    SceneDescription with_larger_box = scene;
    add_box(with_larger_box, glm::vec3(9e5f), glm::vec3(9e5f + 20.0f), true);
    CHECK(warning_of_steps(with_larger_box).empty());
    // At the corner of the large box.
    SceneDescription with_part = scene;
    add_triangle(with_part, glm::vec3(1e6f), glm::vec3(1e6f - 1.0f), {1e6f - 1.0f, 1e6f, 1e6f});
    CHECK(warning_of_steps(with_part).empty());
    SceneDescription with_point = scene;
    add_triangle(with_point, glm::vec3(9e5f), glm::vec3(9e5f), glm::vec3(9e5f));
    CHECK(warning_of_steps(with_point).empty());
}

TEST_CASE("A camera that is too far for the steps of floats is named") {
    SceneDescription scene = box_with_lights();
    scene.camera.eye = {0.0f, 0.0f, 1e4f};
    CHECK(warning_of_steps(scene).empty());
    scene.camera.eye = {0.0f, 0.0f, 1e6f};
    CHECK_THAT(warning_of_steps(scene), Catch::Contains("the camera is 1000000 away"));
}
