// References of the window: in the store of `pathlight reference`, continued, and used for exactly one picture.
// References in the viewer: found for the picture in the window, rendered in the background, stopped, refused.
#include "ui/model/references.h"

#include <fstream>

#include "core/bench/reference_store.h"
#include "core/io/load_scene.h"
#include "core/measure/picture_identity.h"
#include "core/scene/scene_hash.h"
#include "cpu/cpu_backend.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/temporary_folder.h"
#include "tests/ui/model_bench.h"
#include "tests/ui/worker_bench.h"
#include "ui/model/viewer_model.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

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

std::shared_ptr<const StoredReference> find_in(const TemporaryFolder& folder, const SceneDescription& scene,
                                               const RenderSettings& settings) {
    return find_stored_reference(folder.path(), picture_key(scene_hash(scene), settings), settings);
}

}  // namespace

TEST_CASE("Stored reference: one that is stopped at once has both halves, is found and continued") {
    const TemporaryFolder folder;
    const auto scene = std::make_shared<const SceneDescription>(load_scene("cornell", find_assets_dir()));
    const RenderSettings settings = small_settings(*scene);
    CHECK(find_in(folder, *scene, settings) == nullptr);
    const auto made = make_for(0, folder.path(), scene, settings);
    REQUIRE(made != nullptr);
    CHECK(made->spp[0] >= 1);
    CHECK(made->spp[1] >= 1);
    CHECK(made->halves.picture == picture_key(scene_hash(*scene), settings));
    CHECK(made->halves.first.size() == 256);
    CHECK(made->halves.first != made->halves.second);
    const auto found = find_in(folder, *scene, settings);
    REQUIRE(found != nullptr);
    CHECK(found->spp == made->spp);
    CHECK(found->halves.first == made->halves.first);
    // The reference in the store of `pathlight reference`.
    CHECK(
        bench::ReferenceStore(folder.path()).require(bench::content_of(scene_hash(*scene), settings)).has_samples());
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
    CHECK(find_in(folder, brighter, settings) == nullptr);
    RenderSettings other = settings;
    other.camera.eye.x += 1.0f;
    CHECK(find_in(folder, *scene, other) == nullptr);
    other = settings;
    other.width = 32;
    CHECK(find_in(folder, *scene, other) == nullptr);
    other = settings;
    other.max_depth = 5;
    CHECK(find_in(folder, *scene, other) == nullptr);
    other = settings;  // these decide its noise alone
    other.method = MethodId::Default;
    other.next_event = true;
    other.seed = 99;
    CHECK(find_in(folder, *scene, other) != nullptr);
}

}  // namespace pl::test

namespace {

/// A viewer with a folder of references, whose halves are of one color each.
struct ReferenceBench : ModelBench {
    TemporaryFolder folder;

    ReferenceBench() : ModelBench(kSize) { options.reference_dir = folder.path() / "references"; }

    /// Stores a reference of the picture that the window opens with.
    void store() const {
        bench::Reference reference{.name = "small-" + content().picture_hash, .content = content(), .halves = {}};
        const auto pixels = static_cast<std::size_t>(options.settings.width * options.settings.height);
        const auto half = [&](float value, std::uint32_t spp) {
            return bench::ReferenceHalf{.image = {.width = options.settings.width,
                                                  .height = options.settings.height,
                                                  .pixels = std::vector<Vec3f>(pixels, Vec3f{value})},
                                        .spp = spp,
                                        .parts = 1};
        };
        reference.halves = {half(1.0f, 3), half(3.0f, 1)};
        std::filesystem::create_directories(options.reference_dir);
        const bench::ReferenceStore references(options.reference_dir);
        references.save_half(reference, 0);
        references.save_half(reference, 1);
    }
    bench::PictureContent content() const { return bench::content_of(scene_hash(*small_scene()), options.settings); }
};

}  // namespace

TEST_CASE("References: a stored one is found, and runs are measured against it") {
    ReferenceBench bench;
    bench.store();
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.references().current() != nullptr; }));
    CHECK(model.references().current()->label == "reference  3 + 1 spp");
    CHECK(model.references().current()->noise_relmse > 0.0);
    CHECK(model.references().current()->pixels->rgb[0] == 0x3e00);  // 1.5: the mean by samples
    REQUIRE(bench.run_until(model, [&] {
        const auto runs = model.comparison().accuracy().runs();
        return !runs.empty() && runs[0]->points[0].metrics.has_value();
    }));
    CHECK(bench.run_until(model, [&] { return model.comparison().accuracy().kind().metric == ErrorMetric::RelMse; }));
}

TEST_CASE("References: rendering one holds the picture, and ending it keeps its samples") {
    ReferenceBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.status().picture != 0; }));
    model.references().make();
    const auto share = [&] { return model.references().progress() ? model.references().progress()->share : 0.0; };
    REQUIRE(bench.run_until(model, [&] { return share() > 0.0 && model.status().state == WorkerState::Paused; }));
    CHECK_FALSE(model.render().paused());  // the user has not paused it
    const double seconds = model.status().seconds;
    const double before = share();
    REQUIRE(bench.run_until(model, [&] { return share() > before; }));
    CHECK(model.status().seconds == seconds);
    model.references().make();  // without effect: one is being rendered
    model.cancel();
    REQUIRE(bench.run_until(model, [&] { return model.references().current() != nullptr; }));
    CHECK_FALSE(model.references().progress().has_value());
    CHECK(bench::ReferenceStore(bench.options.reference_dir).require(bench.content()).has_samples());
    CHECK(bench.run_until(model, [&] { return model.status().seconds > seconds; }));  // rendering continues
}

TEST_CASE("References: a pause by the user outlasts it") {
    ReferenceBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.status().picture != 0; }));
    model.render().set_paused(true);
    model.references().make();
    model.cancel();
    REQUIRE(bench.run_until(model, [&] { return model.references().current() != nullptr; }));
    CHECK(bench.run_until(model, [&] { return model.status().state == WorkerState::Paused; }));
}

TEST_CASE("References: a failure is reported, and closing the window ends the work") {
    ReferenceBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.status().picture != 0; }));
    std::ofstream(bench.options.reference_dir) << "not a folder";
    model.references().make();
    REQUIRE(bench.run_until(model, [&] { return told(model, "could not be rendered: "); }));
    std::filesystem::remove(bench.options.reference_dir);
    model.references().make();
    REQUIRE(bench.run_until(model, [&] {
        const auto progress = model.references().progress();
        return progress && progress->share > 0.0;
    }));
}

TEST_CASE("References: the picture of another camera has none, and the old camera has it again") {
    ReferenceBench bench;
    bench.store();
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.references().current() != nullptr; }));
    const std::uint64_t before = model.status().picture;
    model.camera().set(camera_at(2.0f));
    REQUIRE(bench.run_until(model, [&] { return model.status().picture != 0 && model.status().picture != before; }));
    CHECK(model.references().current() == nullptr);
    model.camera().go_home();
    REQUIRE(bench.run_until(model, [&] { return model.status().picture == before; }));
    CHECK(model.references().current() != nullptr);
}
