// Scenes that must not reach the renderer, and the camera's way up.
#include "core/scene/validate.h"

#include <functional>

#include "core/kernel/base/math.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/input_error.h"

using namespace pl;
using pl::test::contains;
using pl::test::input_error;

namespace {

SceneDescription good() {
    SceneDescription scene;
    scene.source = "some.obj";
    scene.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    scene.normals = {{0, 0, 1}};
    scene.materials = {{.name = "wall", .albedo = glm::vec3(0.5f)}};
    scene.triangles = {{.vertex = {0, 1, 2}, .normal = {0, 0, TriangleDescription::kNoNormal}, .material = 0}};
    return scene;
}

}  // namespace

TEST_CASE("A good scene has no complaints") { CHECK_NOTHROW(validate_scene(good())); }

TEST_CASE("Each kind of fault is named") {
    struct Case {
        std::function<void(SceneDescription&)> spoil;
        std::string told;
    };
    const Case sample = GENERATE(
        Case{[](SceneDescription& s) { s.triangles.clear(); }, "there are no triangles"},
        Case{[](SceneDescription& s) { s.triangles[0].vertex.z = 3; },
             "triangle 0: vertex 3 is out of range, there are 3"},
        Case{[](SceneDescription& s) { s.triangles[0].normal.x = 1; },
             "triangle 0: normal 1 is out of range, there are 1"},
        Case{[](SceneDescription& s) { s.triangles[0].material = 1; }, "triangle 0: material 1 is out of range"},
        Case{[](SceneDescription& s) { s.positions[1].y = kNan; }, "vertex 1 is not finite"},
        Case{[](SceneDescription& s) { s.normals[0].y = kInfinity; }, "normal 0 is not finite"},
        Case{[](SceneDescription& s) { s.materials[0].albedo.x = 1.001f; }, "material 'wall': albedo"},
        Case{[](SceneDescription& s) { s.materials[0].albedo.x = -0.001f; }, "material 'wall': albedo"},
        Case{[](SceneDescription& s) { s.materials[0].albedo.x = kNan; }, "material 'wall': albedo"},
        Case{[](SceneDescription& s) { s.materials[0].emission.z = -1.0f; }, "material 'wall': emission"},
        Case{[](SceneDescription& s) { s.materials[0].emission.z = kInfinity; }, "material 'wall': emission"},
        Case{[](SceneDescription& s) { s.materials[0].opacity = 1.001f; }, "material 'wall': opacity 1.001"},
        Case{[](SceneDescription& s) { s.materials[0].opacity = -0.001f; }, "material 'wall': opacity -0.001"},
        Case{[](SceneDescription& s) { s.vertex_colors.resize(2); }, "there are 2 colors of 3 vertices"},
        Case{[](SceneDescription& s) { s.vertex_colors.assign(3, glm::vec3(1, 1.5f, 1)); },
             "the color (1 1.5 1) of vertex 0 is not within [0, 1] (3 such)"},
        Case{[](SceneDescription& s) { s.vertex_colors.assign(3, glm::vec3(kNan)); }, "of vertex 0 is not within"},
        Case{[](SceneDescription& s) { s.materials[0].opacity = kNan; }, "material 'wall': opacity nan"},
        Case{[](SceneDescription& s) { s.environment.y = kNan; }, "environment radiance"},
        Case{[](SceneDescription& s) { s.camera.eye = s.camera.target; }, "eye and target are the same point"},
        Case{[](SceneDescription& s) { s.camera.up.x = kNan; }, "eye, target and up must be finite"},
        Case{[](SceneDescription& s) { s.camera.fov_deg = 0.0f; }, "field of view 0"},
        Case{[](SceneDescription& s) { s.camera.fov_deg = 180.0f; }, "field of view 180"},
        Case{[](SceneDescription& s) { s.camera.fov_deg = kNan; }, "field of view nan"});
    INFO(sample.told);
    SceneDescription scene = good();
    sample.spoil(scene);
    CHECK_THAT(input_error([&] { validate_scene(scene); }),
               contains("some.obj: the scene is not valid:") && contains(sample.told));
}

TEST_CASE("All faults are told at once, each kind with its number") {
    SceneDescription scene = good();
    scene.positions[0].x = kNan;
    scene.positions[2].x = kNan;
    scene.materials[0].emission.x = -1.0f;
    scene.camera.fov_deg = -1.0f;
    CHECK_THAT(input_error([&] { validate_scene(scene); }), contains("vertex 0 is not finite: (nan 0 0) (2 such)") &&
                                                                contains("emission") && contains("field of view"));
}

TEST_CASE("A usable up vector is kept, any other is replaced by one that is") {
    const auto up_of = [](const glm::vec3& view, const glm::vec3& up) {
        return usable_up({.eye = {1, 2, 3}, .target = glm::vec3(1, 2, 3) + view, .up = up, .fov_deg = 40});
    };
    CHECK(up_of({0, 0, -1}, {0, 1, 0}) == glm::vec3(0, 1, 0));
    CHECK(up_of({0, -1, 0.001f}, {0, 3, 0}) == glm::vec3(0, 3, 0));
    CHECK(up_of({0, -1, 0}, {0, 1, 0}) == glm::vec3(0, 0, -1));
    CHECK(up_of({0, 5, 0}, {0, -2, 0}) == glm::vec3(0, 0, -1));
    CHECK(up_of({0, 0, 2}, {0, 0, 1}) == glm::vec3(0, 1, 0));
    CHECK(up_of({3, 0, 0}, {0, 0, 0}) == glm::vec3(0, 1, 0));
    for (const glm::vec3& view : {glm::vec3(1, 1, 1), glm::vec3(-1, 2, 3), glm::vec3(4, 2, -3),
                                  glm::vec3(4, -5, 4.5f), glm::vec3(4.5f, -5, 4)}) {
        const glm::vec3 up = up_of(view, 2.0f * view);
        CHECK(glm::length(glm::cross(glm::normalize(view), up)) > 0.5f);
    }
}

TEST_CASE("Each kind of fault of surfaces, textures, far lights and lenses is named") {
    struct Case {
        std::function<void(SceneDescription&)> spoil;
        std::string told;
    };
    const Case sample = GENERATE(
        Case{[](SceneDescription& s) { s.materials[0].roughness = 1.5f; }, "roughness 1.5"},
        Case{[](SceneDescription& s) { s.materials[0].roughness = kNan; }, "roughness nan"},
        Case{[](SceneDescription& s) { s.materials[0].anisotropy = 1.0f; }, "anisotropy 1 is not within [0, 0.99]"},
        Case{[](SceneDescription& s) { s.materials[0].rotation_deg = kNan; }, "rotation nan is not finite"},
        Case{[](SceneDescription& s) { s.materials[0].ior = 0.9f; }, "index of refraction 0.9 is not within [1, 4]"},
        Case{[](SceneDescription& s) { s.materials[0].specular.x = 2.0f; }, "specular (2"},
        Case{[](SceneDescription& s) { s.materials[0].transmission.x = kNan; }, "transmission (nan"},
        Case{[](SceneDescription& s) { s.triangles[0].uv.x = 0; }, "texture point 0 is out of range"},
        Case{[](SceneDescription& s) { s.materials[0].textures.blend = 0; }, "there is no texture 0"},
        Case{[](SceneDescription& s) { s.materials[0].blend = {.other = 7}; },
             "materials to blend with, got number 7"},
        Case{[](SceneDescription& s) { s.materials[0].blend = {.other = 0}; }, "at most 8 blends in a row"},
        Case{[](SceneDescription& s) {
                 s.materials.push_back(s.materials[0]);
                 s.materials[0].blend = {.other = 1, .share = kNan};
             },
             "share nan of a blend is not within [0, 1]"},
        Case{[](SceneDescription& s) {
                 s.materials.push_back({.name = "ice", .kind = SurfaceKind::Dielectric});
                 s.materials[0].blend = {.other = static_cast<std::uint32_t>(s.materials.size() - 1)};
             },
             "expected no solid glass in a blend, got 'ice'"},
        Case{[](SceneDescription& s) { s.materials[0].textures.albedo = 0; }, "there is no texture 0"},
        Case{[](SceneDescription& s) { s.textures.push_back({.source = "t.png", .width = 1, .height = 2}); },
             "1x2 with 0 texels"},
        Case{[](SceneDescription& s) {
                 s.textures.push_back({.source = "t.png", .width = 1, .height = 1, .texels = {{1, 1, kNan, 1}}});
             },
             "a texel is no color"},
        Case{[](SceneDescription& s) {
                 s.textures.push_back({.source = "t.png", .width = 1, .height = 1, .texels = {{1e5f, 1, 1, 1}}});
                 s.materials[0].emission = glm::vec3(1e38f);
                 s.materials[0].textures.emission = 0;
             },
             "emission times its texture is not finite"},
        Case{[](SceneDescription& s) {
                 s.environment_map.width = 1;
                 s.environment_map.height = 1;
             },
             "1x1 with 0 texels"},
        Case{[](SceneDescription& s) {
                 s.environment_map = {.width = 1, .height = 1, .texels = {{1, -1, 1}}};
             },
             "environment map: radiance (1 -1 1)"},
        Case{[](SceneDescription& s) { s.sun.radiance.x = kInfinity; }, "sun: radiance"},
        Case{[](SceneDescription& s) { s.sun.direction = glm::vec3(0.0f); }, "is no direction"},
        Case{[](SceneDescription& s) { s.sun.angle_deg = 0.0f; }, "sun: angle 0"},
        Case{[](SceneDescription& s) { s.camera.aperture_radius = -1.0f; }, "aperture radius -1"},
        Case{[](SceneDescription& s) { s.camera.focus_distance = 0.0f; }, "focus distance 0"});
    INFO(sample.told);
    SceneDescription scene = good();
    sample.spoil(scene);
    CHECK_THAT(input_error([&] { validate_scene(scene); }), contains(sample.told));
}
