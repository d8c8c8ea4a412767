// References in the viewer: found for the picture in the window, made in the background, stopped, refused.
#include <algorithm>
#include <fstream>

#include "core/bench/reference_store.h"
#include "tests/catch.hpp"
#include "tests/io/temporary_folder.h"
#include "tests/ui/model_bench.h"
#include "tests/ui/worker_bench.h"
#include "ui/viewer_model.h"

using namespace pl;
using namespace pl::test;

namespace {

/// A viewer with a folder of references, whose halves are of one color each.
struct ReferenceBench : ModelBench {
    TemporaryFolder folder;

    ReferenceBench() : ModelBench(kSize) { options.reference_dir = folder.path() / "references"; }

    /// Stores a reference of the picture that the window opens with.
    void store() const {
        Reference reference{.name = "small-" + content().picture_hash, .content = content(), .halves = {}};
        const auto pixels = static_cast<std::size_t>(options.settings.width * options.settings.height);
        const auto half = [&](float value, std::uint32_t spp) {
            return ReferenceHalf{.image = {.width = options.settings.width,
                                           .height = options.settings.height,
                                           .pixels = std::vector<Vec3f>(pixels, Vec3f{value})},
                                 .spp = spp,
                                 .parts = 1};
        };
        reference.halves = {half(1.0f, 3), half(3.0f, 1)};
        std::filesystem::create_directories(options.reference_dir);
        const ReferenceStore references(options.reference_dir);
        references.save_half(reference, 0);
        references.save_half(reference, 1);
    }
    PictureContent content() const { return content_of(*small_scene(), options.settings); }
};

bool told(const ViewerModel& model, const std::string& part) {
    return std::any_of(model.log().begin(), model.log().end(),
                       [&](const LogLine& line) { return line.text.find(part) != std::string::npos; });
}

}  // namespace

TEST_CASE("Viewer reference: one that is stored is found, and runs are measured against it") {
    ReferenceBench bench;
    bench.store();
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.reference() != nullptr; }));
    CHECK(model.reference()->label == "reference  3 + 1 spp");
    CHECK(model.reference()->noise_relmse > 0.0);
    CHECK(model.reference()->pixels->rgb[0] == 0x3e00);  // 1.5: the mean by samples
    REQUIRE(bench.run_until(model, [&] {
        const auto runs = model.accuracy().runs();
        return !runs.empty() && runs[0]->points[0].metrics.has_value();
    }));
    CHECK(bench.run_until(model, [&] { return model.accuracy().kind().metric == ErrorMetric::RelMse; }));
}

TEST_CASE("Viewer reference: making one holds the rendering, and stopping it keeps its samples") {
    ReferenceBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.status().picture != 0; }));
    model.make_reference();
    const auto share = [&] { return model.reference_progress() ? model.reference_progress()->share : 0.0; };
    REQUIRE(bench.run_until(model, [&] { return share() > 0.0 && model.status().state == WorkerState::Paused; }));
    CHECK_FALSE(model.paused());  // nobody paused it by hand
    const double seconds = model.status().seconds;
    const double before = share();
    REQUIRE(bench.run_until(model, [&] { return share() > before; }));
    CHECK(model.status().seconds == seconds);
    model.make_reference();  // without effect: one is being made
    model.cancel();
    REQUIRE(bench.run_until(model, [&] { return model.reference() != nullptr; }));
    CHECK_FALSE(model.reference_progress().has_value());
    CHECK(ReferenceStore(bench.options.reference_dir).require(bench.content()).has_samples());
    CHECK(bench.run_until(model, [&] { return model.status().seconds > seconds; }));  // rendering goes on
}

TEST_CASE("Viewer reference: a pause by hand outlasts the making of one") {
    ReferenceBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.status().picture != 0; }));
    model.set_paused(true);
    model.make_reference();
    model.cancel();
    REQUIRE(bench.run_until(model, [&] { return model.reference() != nullptr; }));
    CHECK(bench.run_until(model, [&] { return model.status().state == WorkerState::Paused; }));
}

TEST_CASE("Viewer reference: a failure is told, and closing the window stops the making") {
    ReferenceBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.status().picture != 0; }));
    std::ofstream(bench.options.reference_dir) << "not a folder";
    model.make_reference();
    REQUIRE(bench.run_until(model, [&] { return told(model, "could not be made: "); }));
    std::filesystem::remove(bench.options.reference_dir);
    model.make_reference();
    REQUIRE(bench.run_until(model,
                            [&] { return model.reference_progress() && model.reference_progress()->share > 0.0; }));
}

TEST_CASE("Viewer reference: the picture of another camera has none, and the way back finds it again") {
    ReferenceBench bench;
    bench.store();
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.reference() != nullptr; }));
    const std::uint64_t before = model.status().picture;
    model.set_camera(camera_at(2.0f));
    REQUIRE(bench.run_until(model, [&] { return model.status().picture != 0 && model.status().picture != before; }));
    CHECK(model.reference() == nullptr);
    model.camera_home();
    REQUIRE(bench.run_until(model, [&] { return model.status().picture == before; }));
    CHECK(model.reference() != nullptr);
}
