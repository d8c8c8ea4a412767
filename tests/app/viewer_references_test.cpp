// The references of the viewer: in the store that `pathlight reference` keeps, gone on with, and of just one picture.
#include "app/viewer_references.h"

#include "app/measure/reference_store.h"
#include "core/io/load_scene.h"
#include "core/measure/picture_identity.h"
#include "tests/support/catch.hpp"
#include "tests/support/program/run_program.h"

namespace pl::test {
namespace {

RenderSettings small_settings(const SceneDescription& scene) {
    RenderSettings settings;
    settings.width = 16;
    settings.height = 16;
    settings.camera = scene.camera;
    settings.method = MethodId::Reinforcement;  // of the viewer: a reference is made without
    return settings;
}

/// Stops after so many looks.
JobMonitor stop_after(int& looks) {
    return {.stopped = [&looks] { return --looks < 0; }, .progress = [](double, const std::string&) {}};
}

}  // namespace

TEST_CASE("a viewer's reference that is ended at once has both halves, and is found and gone on with") {
    const TempDir folder;
    const auto scene = std::make_shared<const SceneDescription>(load_scene("cornell", find_assets_dir()));
    const RenderSettings settings = small_settings(*scene);
    CHECK(find_viewer_reference(folder.path(), *scene, settings) == nullptr);
    int looks = 0;
    const auto made = make_viewer_reference(folder.path(), "cornell", scene, settings, 1, stop_after(looks));
    REQUIRE(made != nullptr);
    CHECK(made->spp[0] >= 1);
    CHECK(made->spp[1] >= 1);
    CHECK(made->halves.picture == picture_key(*scene, settings));
    CHECK(made->halves.first.size() == 256);
    CHECK(made->halves.first != made->halves.second);
    const auto found = find_viewer_reference(folder.path(), *scene, settings);
    REQUIRE(found != nullptr);
    CHECK(found->spp == made->spp);
    CHECK(found->halves.first == made->halves.first);
    // The command finds the same one.
    CHECK(ReferenceStore(folder.path()).require(content_of(*scene, settings)).has_samples());
    looks = 20;
    const auto more = make_viewer_reference(folder.path(), "cornell", scene, settings, 1, stop_after(looks));
    CHECK(more->spp[0] + more->spp[1] > made->spp[0] + made->spp[1]);
}

TEST_CASE("a viewer's reference of other light, camera, size or depth is not found") {
    const TempDir folder;
    const auto scene = std::make_shared<const SceneDescription>(load_scene("cornell", find_assets_dir()));
    const RenderSettings settings = small_settings(*scene);
    int looks = 0;
    REQUIRE(make_viewer_reference(folder.path(), "cornell", scene, settings, 1, stop_after(looks)) != nullptr);
    SceneDescription brighter = *scene;
    for (MaterialDescription& material : brighter.materials) material.emission *= 2.0f;
    CHECK(find_viewer_reference(folder.path(), brighter, settings) == nullptr);
    RenderSettings other = settings;
    other.camera.eye.x += 1.0f;
    CHECK(find_viewer_reference(folder.path(), *scene, other) == nullptr);
    other = settings;
    other.width = 32;
    CHECK(find_viewer_reference(folder.path(), *scene, other) == nullptr);
    other = settings;
    other.max_depth = 5;
    CHECK(find_viewer_reference(folder.path(), *scene, other) == nullptr);
    other = settings;  // settings that decide the noise alone do not count
    other.method = MethodId::Default;
    other.next_event = true;
    other.seed = 99;
    CHECK(find_viewer_reference(folder.path(), *scene, other) != nullptr);
}

}  // namespace pl::test
