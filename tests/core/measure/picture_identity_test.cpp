// Settings that belong to the identity of a converged picture, and settings that do not.
#include "core/measure/picture_identity.h"

#include <functional>

#include "core/scene/scene_hash.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/closed_scenes.h"

namespace pl::test {

TEST_CASE("everything that decides the converged picture changes its hash") {
    const SceneDescription scene = furnace_scene(1.0f, 0.5f);
    RenderSettings settings;
    settings.camera = scene.camera;
    const std::string hash = picture_hash(scene_hash(scene), settings);
    CHECK(hash.size() == 16);
    const std::vector<std::function<void(SceneDescription&, RenderSettings&)>> changes{
        [](SceneDescription& s, RenderSettings&) { s.materials[0].emission *= 1.01f; },  // light power
        [](SceneDescription& s, RenderSettings&) { s.materials[0].albedo.x += 0.01f; },
        [](SceneDescription& s, RenderSettings&) { s.positions[0].x += 0.01f; },
        [](SceneDescription& s, RenderSettings&) { s.environment.z = 0.1f; },
        [](SceneDescription&, RenderSettings& r) { r.camera.eye.x += 0.01f; },
        [](SceneDescription&, RenderSettings& r) { r.camera.target.y += 0.01f; },
        [](SceneDescription&, RenderSettings& r) { r.camera.up.x += 0.01f; },
        [](SceneDescription&, RenderSettings& r) { r.camera.fov_deg += 0.01f; },
        [](SceneDescription&, RenderSettings& r) { r.camera.aperture_radius = 0.01f; },
        [](SceneDescription& s, RenderSettings&) { s.sun.radiance = glm::vec3(1.0f); },
        [](SceneDescription& s, RenderSettings&) {
            s.environment_map = {.width = 1, .height = 1, .texels = {{1, 1, 1}}};
        },
        [](SceneDescription& s, RenderSettings&) { s.materials[0].kind = SurfaceKind::Plastic; },
        [](SceneDescription& s, RenderSettings&) {
            s.textures = {{.width = 1, .height = 1, .texels = {{1, 1, 1, 1}}}};
            s.materials[0].textures.albedo = 0;
        },
        [](SceneDescription&, RenderSettings& r) { ++r.width; },
        [](SceneDescription&, RenderSettings& r) { std::swap(r.width, ++r.height); },
        [](SceneDescription&, RenderSettings& r) { --r.max_depth; },
    };
    for (std::size_t i = 0; i < changes.size(); ++i) {
        SceneDescription changed = scene;
        RenderSettings other = settings;
        changes[i](changed, other);
        CAPTURE(i);
        CHECK(picture_hash(scene_hash(changed), other) != hash);
    }
}

TEST_CASE("settings that only decide the noise do not change the hash") {
    SceneDescription scene = furnace_scene(1.0f, 0.5f);
    RenderSettings settings;
    const std::string hash = picture_hash(scene_hash(scene), settings);
    settings.method = MethodId::Reinforcement;
    settings.seed = 77;
    settings.next_event = true;
    settings.field.volumes = 5;
    settings.mixture.bsdf_fraction = 0.3f;
    scene.name = "another";
    scene.materials[0].name = "renamed";
    scene.camera.eye.x += 1.0f;             // the scene's own camera is not the one that is looked through
    settings.camera.focus_distance = 7.0f;  // of a pinhole
    scene.textures = {{.width = 1, .height = 1, .texels = {{1, 1, 1, 1}}}};  // of no material
    scene.uvs = {{0, 0}};
    CHECK(picture_hash(scene_hash(scene), settings) == hash);
}

}  // namespace pl::test
