// References in the viewer: found for the picture in the window, made in the background, ended, refused.
#include "core/base/error.h"
#include "core/measure/picture_identity.h"
#include "tests/support/catch.hpp"
#include "tests/ui/model_bench.h"
#include "tests/ui/worker_bench.h"
#include "ui/model/viewer_model.h"

using namespace pl;
using namespace pl::test;

namespace {

/// A viewer whose references are all of one color, made of one sample for every look at the monitor.
struct ReferenceBench : ModelBench {
    std::atomic<bool> stored{false};  ///< find_reference has one
    std::atomic<bool> other_light{false};
    std::atomic<bool> broken{false};
    std::atomic<bool> finish{false};
    std::atomic<int> looks{0};

    ReferenceBench() : ModelBench(kSize) {
        options.find_reference = [this](const OpenScene&, const RenderSettings& settings) {
            return stored ? make(settings) : nullptr;
        };
        options.make_reference = [this](const OpenScene&, const RenderSettings& settings, const JobMonitor& monitor) {
            if (broken) throw Error(ErrorKind::Input, "the disk is full");
            bool started = false;
            while (!finish && !monitor.stopped()) {
                monitor.progress(0.25, "half 1");
                started = true;
                ++looks;
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            }
            return started || finish ? make(settings) : nullptr;
        };
    }

    std::shared_ptr<const StoredReference> make(const RenderSettings& settings) const {
        auto reference = std::make_shared<StoredReference>();
        const auto pixels = static_cast<std::size_t>(settings.width * settings.height);
        reference->halves = {.picture = picture_key(*small_scene(), settings) + (other_light ? 1u : 0u),
                             .width = settings.width,
                             .height = settings.height,
                             .first = std::vector<Vec3f>(pixels, Vec3f{1.0f}),
                             .second = std::vector<Vec3f>(pixels, Vec3f{3.0f})};
        reference->spp = {3, 1};
        reference->noise_relmse = 1e-3;
        return reference;
    }
};

}  // namespace

TEST_CASE("References: a stored one is found, and runs are measured against it") {
    ReferenceBench bench;
    bench.stored = true;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.references().current() != nullptr; }));
    CHECK(model.references().current()->label == "reference  3 + 1 spp");
    CHECK(model.references().current()->noise_relmse == 1e-3);
    CHECK(model.references().current()->pixels->rgb[0] == 0x3e00);  // 1.5: the mean by samples
    REQUIRE(bench.run_until(model, [&] {
        const auto runs = model.comparison().accuracy().runs();
        return !runs.empty() && runs[0]->points[0].metrics.has_value();
    }));
    CHECK(bench.run_until(model, [&] { return model.comparison().accuracy().kind().metric == ErrorMetric::RelMse; }));
}

TEST_CASE("References: errors are never measured against one of another picture") {
    ReferenceBench bench;
    bench.stored = true;
    bench.other_light = true;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(
        model, [&] { return told(model, "reference") && model.comparison().accuracy().runs().size() == 1; }));
    CHECK(model.references().current() == nullptr);
    CHECK_FALSE(model.comparison().accuracy().runs()[0]->points[0].metrics.has_value());
    CHECK(model.comparison().accuracy().kind().metric == ErrorMetric::Noise);
}

TEST_CASE("References: rendering one holds the picture, and ending it keeps its samples") {
    ReferenceBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.status().picture != 0; }));
    model.references().make();
    REQUIRE(bench.run_until(model, [&] { return bench.looks > 3 && model.status().state == WorkerState::Paused; }));
    CHECK_FALSE(model.render().paused());  // a person did not ask for that
    CHECK(model.references().progress()->share == 0.25);
    const double seconds = model.status().seconds;
    const int looks = bench.looks;
    REQUIRE(bench.run_until(model, [&] { return bench.looks > looks + 5; }));
    CHECK(model.status().seconds == seconds);
    model.references().make();  // there is one already
    model.cancel();
    REQUIRE(bench.run_until(model, [&] { return model.references().current() != nullptr; }));
    CHECK_FALSE(model.references().progress().has_value());
    CHECK(bench.run_until(model, [&] { return model.status().seconds > seconds; }));  // rendering goes on
}

TEST_CASE("References: a pause by the user outlasts it") {
    ReferenceBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.status().picture != 0; }));
    model.render().set_paused(true);
    model.references().make();
    bench.finish = true;
    REQUIRE(bench.run_until(model, [&] { return model.references().current() != nullptr; }));
    CHECK(bench.run_until(model, [&] { return model.status().state == WorkerState::Paused; }));
}

TEST_CASE("References: a failure is reported, and closing the window ends the work") {
    ReferenceBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.status().picture != 0; }));
    bench.broken = true;
    model.references().make();
    REQUIRE(bench.run_until(model, [&] { return told(model, "could not be rendered: the disk is full"); }));
    bench.broken = false;
    model.references().make();
    REQUIRE(bench.run_until(model, [&] { return bench.looks > 0; }));
}

TEST_CASE("References: the picture of another camera has none, and the old camera has it again") {
    ReferenceBench bench;
    bench.stored = true;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.references().current() != nullptr; }));
    bench.stored = false;
    const std::uint64_t before = model.status().picture;
    model.camera().set(camera_at(2.0f));
    REQUIRE(bench.run_until(model, [&] { return model.status().picture != 0 && model.status().picture != before; }));
    CHECK(model.references().current() == nullptr);
    model.camera().go_home();
    REQUIRE(bench.run_until(model, [&] { return model.status().picture == before; }));
    CHECK(model.references().current() != nullptr);
}
