// References of the window: in the store of `pathlight reference`, continued, and used for exactly one picture.
#include "ui/model/stored_reference.h"

#include "core/bench/reference_store.h"
#include "core/io/load_scene.h"
#include "core/measure/picture_identity.h"
#include "cpu/cpu_backend.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/temporary_folder.h"

namespace pl::test {
using namespace pl::ui;
namespace {

RenderSettings small_settings(const SceneDescription& scene) {
    RenderSettings settings;
    settings.width = 16;
    settings.height = 16;
    settings.camera = scene.camera;
    settings.method = MethodId::Reinforcement;  // the viewer's method: references use another
    return settings;
}

/// Renders a reference and stops after this many passes.
std::shared_ptr<const StoredReference> make_for(int passes, const std::filesystem::path& folder,
                                                const std::shared_ptr<const SceneDescription>& scene,
                                                const RenderSettings& settings) {
    StopFlag stop{passes == 0};
    const JobMonitor monitor{.stop = &stop, .progress = [&](double, const std::string&) { stop = --passes <= 0; }};
    const auto make = [](const std::string&) { return make_cpu_backend({.threads = 1}); };
    return make_stored_reference(folder, {.name = "cornell", .description = scene}, settings, make, monitor);
}

}  // namespace

TEST_CASE("Stored reference: one that is stopped at once has both halves, is found and continued") {
    const TemporaryFolder folder;
    const auto scene = std::make_shared<const SceneDescription>(load_scene("cornell", find_assets_dir()));
    const RenderSettings settings = small_settings(*scene);
    CHECK(find_stored_reference(folder.path(), *scene, settings) == nullptr);
    const auto made = make_for(0, folder.path(), scene, settings);
    REQUIRE(made != nullptr);
    CHECK(made->spp[0] >= 1);
    CHECK(made->spp[1] >= 1);
    CHECK(made->halves.picture == picture_key(*scene, settings));
    CHECK(made->halves.first.size() == 256);
    CHECK(made->halves.first != made->halves.second);
    const auto found = find_stored_reference(folder.path(), *scene, settings);
    REQUIRE(found != nullptr);
    CHECK(found->spp == made->spp);
    CHECK(found->halves.first == made->halves.first);
    // The reference in the store of `pathlight reference`.
    CHECK(bench::ReferenceStore(folder.path()).require(bench::content_of(*scene, settings)).has_samples());
    const auto more = make_for(20, folder.path(), scene, settings);
    CHECK(more->spp[0] + more->spp[1] > made->spp[0] + made->spp[1]);
}

TEST_CASE("Stored reference: one of other light, camera, size or depth is not found") {
    const TemporaryFolder folder;
    const auto scene = std::make_shared<const SceneDescription>(load_scene("cornell", find_assets_dir()));
    const RenderSettings settings = small_settings(*scene);
    REQUIRE(make_for(0, folder.path(), scene, settings) != nullptr);
    SceneDescription brighter = *scene;
    for (MaterialDescription& material : brighter.materials) material.emission *= 2.0f;
    CHECK(find_stored_reference(folder.path(), brighter, settings) == nullptr);
    RenderSettings other = settings;
    other.camera.eye.x += 1.0f;
    CHECK(find_stored_reference(folder.path(), *scene, other) == nullptr);
    other = settings;
    other.width = 32;
    CHECK(find_stored_reference(folder.path(), *scene, other) == nullptr);
    other = settings;
    other.max_depth = 5;
    CHECK(find_stored_reference(folder.path(), *scene, other) == nullptr);
    other = settings;  // these decide its noise alone
    other.method = MethodId::Default;
    other.next_event = true;
    other.seed = 99;
    CHECK(find_stored_reference(folder.path(), *scene, other) != nullptr);
}

}  // namespace pl::test
