// References in the viewer: found for the picture in the window, rendered in the background, stopped, refused.
#include <fstream>

#include "core/bench/reference_store.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/temporary_folder.h"
#include "tests/ui/model_bench.h"
#include "tests/ui/worker_bench.h"
#include "ui/model/viewer_model.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

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
    bench::PictureContent content() const { return bench::content_of(*small_scene(), options.settings); }
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
