#include "core/session/render_inputs.h"

#include "core/base/error.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/closed_scenes.h"

using namespace pl;
using namespace pl::test;

namespace {

SessionScene furnace() { return SessionScene(std::make_shared<const SceneDescription>(furnace_scene(0.5f, 0.5f))); }

}  // namespace

TEST_CASE("Session scene: closed surfaces surround cameras inside of them") {
    const SessionScene scene = furnace();
    CHECK(scene.encloses(scene.description()->camera.eye, false) == true);  // a small scene is tested at once
    CHECK(scene.encloses(glm::vec3{1.0e6f}, true) == false);
    CHECK(scene.encloses(scene.description()->camera.eye, true) == true);
}

TEST_CASE("Session scene: edges of many triangles are sorted only where there is time") {
    SceneDescription many = furnace_scene(0.0f, 0.5f);
    const glm::vec3 inside = many.camera.eye;
    for (float x = 10.0f; many.triangles.size() <= 100'000; x += 2.0f)
        add_box(many, {x, 0.0f, 0.0f}, {x + 1.0f, 1.0f, 1.0f}, true);
    const SessionScene scene(std::make_shared<const SceneDescription>(many));
    CHECK_FALSE(scene.encloses(inside, false));
    CHECK(scene.encloses(inside, true) == true);
    CHECK(scene.encloses(inside, false) == true);
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

TEST_CASE("Render inputs: the settings of a film are the session's with its method and view") {
    const RenderInputs inputs{
        .backend = nullptr, .settings = {.width = 30, .height = 20, .next_event = true}, .scene = furnace()};
    const RenderSettings settings = inputs.settings_for({MethodId::Precomputed, View::Depth});
    CHECK(settings.method == MethodId::Precomputed);
    CHECK(settings.view == View::Depth);
    CHECK(settings.width == 30);
    CHECK(inputs.pixel_count() == 600);
    CHECK(inputs.needed_features({MethodId::Default, View::Beauty}).has(Feature::NextEventEstimation));
    CHECK_FALSE(inputs.needed_features({MethodId::Default, View::Depth}).has(Feature::NextEventEstimation));
}
