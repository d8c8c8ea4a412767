// References in the viewer: found for the picture in the window, made in the background, ended, refused.
#include <algorithm>

#include "core/base/error.h"
#include "core/measure/picture_identity.h"
#include "tests/support/catch.hpp"
#include "tests/ui/model_bench.h"
#include "tests/ui/worker_bench.h"
#include "ui/viewer_model.h"

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

bool told(const ViewerModel& model, const std::string& part) {
    return std::any_of(model.log().begin(), model.log().end(),
                       [&](const LogLine& line) { return line.text.find(part) != std::string::npos; });
}

}  // namespace

TEST_CASE("Viewer reference: one that is stored is found, and runs are measured against it") {
    ReferenceBench bench;
    bench.stored = true;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.reference() != nullptr; }));
    CHECK(model.reference()->label == "reference  3 + 1 spp");
    CHECK(model.reference()->noise_relmse == 1e-3);
    CHECK(model.reference()->pixels->rgb[0] == 0x3e00);  // 1.5: the mean by samples
    REQUIRE(bench.run_until(model, [&] {
        const auto runs = model.accuracy().runs();
        return !runs.empty() && runs[0]->points[0].metrics.has_value();
    }));
    CHECK(bench.run_until(model, [&] { return model.accuracy().kind().metric == ErrorMetric::RelMse; }));
}

TEST_CASE("Viewer reference: one of other light is never scored with") {
    ReferenceBench bench;
    bench.stored = true;
    bench.other_light = true;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return told(model, "reference") && model.accuracy().runs().size() == 1; }));
    CHECK(model.reference() == nullptr);
    CHECK_FALSE(model.accuracy().runs()[0]->points[0].metrics.has_value());
    CHECK(model.accuracy().kind().metric == ErrorMetric::Noise);
}

TEST_CASE("Viewer reference: making one holds the rendering, and ending it keeps what is there") {
    ReferenceBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.status().picture != 0; }));
    model.make_reference();
    REQUIRE(bench.run_until(model, [&] { return bench.looks > 3 && model.status().state == WorkerState::Paused; }));
    CHECK_FALSE(model.paused());  // a person did not ask for that
    CHECK(model.reference_progress()->share == 0.25);
    const double seconds = model.status().seconds;
    const int looks = bench.looks;
    REQUIRE(bench.run_until(model, [&] { return bench.looks > looks + 5; }));
    CHECK(model.status().seconds == seconds);
    model.make_reference();  // there is one already
    model.cancel();
    REQUIRE(bench.run_until(model, [&] { return model.reference() != nullptr; }));
    CHECK_FALSE(model.reference_progress().has_value());
    CHECK(bench.run_until(model, [&] { return model.status().seconds > seconds; }));  // rendering goes on
}

TEST_CASE("Viewer reference: a pause that a person asked for outlasts it") {
    ReferenceBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.status().picture != 0; }));
    model.set_paused(true);
    model.make_reference();
    bench.finish = true;
    REQUIRE(bench.run_until(model, [&] { return model.reference() != nullptr; }));
    CHECK(bench.run_until(model, [&] { return model.status().state == WorkerState::Paused; }));
}

TEST_CASE("Viewer reference: a failure is told, and closing the window ends the making") {
    ReferenceBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.status().picture != 0; }));
    bench.broken = true;
    model.make_reference();
    REQUIRE(bench.run_until(model, [&] { return told(model, "could not be made: the disk is full"); }));
    bench.broken = false;
    model.make_reference();
    REQUIRE(bench.run_until(model, [&] { return bench.looks > 0; }));
}

TEST_CASE("Viewer reference: the picture of another camera has none, and the way back finds it again") {
    ReferenceBench bench;
    bench.stored = true;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.reference() != nullptr; }));
    bench.stored = false;
    const std::uint64_t before = model.status().picture;
    model.set_camera(camera_at(2.0f));
    REQUIRE(bench.run_until(model, [&] { return model.status().picture != 0 && model.status().picture != before; }));
    CHECK(model.reference() == nullptr);
    model.camera_home();
    REQUIRE(bench.run_until(model, [&] { return model.status().picture == before; }));
    CHECK(model.reference() != nullptr);
}
