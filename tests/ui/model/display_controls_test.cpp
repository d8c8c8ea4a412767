// Histograms of luminance: counts, percentiles, and the exposure that follows from them.
// The exposure that follows the picture: it settles, never touches the film, and costs nothing while it is off.
#include "ui/model/display_controls.h"

#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"
#include "tests/ui/model_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Display controls: exposure and overlays restart nothing") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.status().passes >= 5; }));
    const std::uint64_t generation = model.status().generation;
    model.display().set_exposure(3.0f);
    model.display().set_curve(ToneCurve::Aces);
    model.display().set_cells(true);
    model.display().set_cells_opacity(2.0f);
    model.window().hemisphere = false;
    REQUIRE(bench.run_until(model, [&] { return has_frame(model) && model.frame()->cells != nullptr; }));
    CHECK(model.status().generation == generation);
    CHECK(model.status().passes >= 5);
    CHECK(model.display().cells_opacity() == 1.0f);
    model.display().set_exposure(1000.0f);
    CHECK(model.display().settings().exposure_ev == 16.0f);
}

TEST_CASE("Display controls: the colors of a heat map end at percentiles of its values, linear or logarithmic") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    PublishedFrame frame;
    for (int i = 1; i <= 1000; ++i) frame.snapshot.pixels.emplace_back(static_cast<float>(i));
    frame.snapshot.pixels[3] = Vec3f{1.0e9f};  // an outlier
    frame.serial = 7;
    DisplayControls& display = model.display();
    CHECK(display.heat_range(frame).scale == ColorScale::Linear);
    CHECK(display.heat_range(frame).high <= 1000.0f);
    display.heat_rule() = {.scale = ColorScale::Logarithmic, .low_percent = 20.0f, .high_percent = 90.0f};
    CHECK(display.heat_range(frame).scale == ColorScale::Logarithmic);
    CHECK_THAT(display.heat_range(frame).low, WithinAbs(200.0f, 5.0f));
    CHECK_THAT(display.heat_range(frame).high, WithinAbs(900.0f, 5.0f));
    // Another picture has another range.
    frame.serial = 8;
    for (Vec3f& pixel : frame.snapshot.pixels) pixel *= 2.0f;
    CHECK_THAT(display.heat_range(frame).high, WithinAbs(1800.0f, 10.0f));
}

TEST_CASE("Histogram: every pixel is counted once") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<Vec3f> pixels{Vec3f{1.0f}, Vec3f{0.0f},  Vec3f{1.0e-9f}, Vec3f{1.0e9f},
                                    Vec3f{nan},  Vec3f{-1.0f}, Vec3f{0.25f},   Vec3f{0.25f}};
    const LuminanceHistogram histogram = make_histogram(pixels);
    CHECK(histogram.pixels == 8);
    CHECK(histogram.dark == 3);
    CHECK(histogram.bright == 1);
    CHECK(histogram.invalid == 1);
    CHECK(histogram.counted() == 3);
    std::uint32_t sum = 0;
    for (const std::uint32_t count : histogram.counts) sum += count;
    CHECK(sum == 3);
}

TEST_CASE("Histogram: percentiles are those of the picture within a bin") {
    std::vector<Vec3f> pixels;
    for (int i = 0; i < 1000; ++i) pixels.emplace_back(std::exp2(-5.0f + 0.01f * static_cast<float>(i)));
    const LuminanceHistogram histogram = make_histogram(pixels);
    for (const float share : {0.05f, 0.25f, 0.5f, 0.95f})
        CHECK(std::fabs(*histogram.percentile(share) - (-5.0f + 10.0f * share)) < 0.25f);
    CHECK(std::fabs(*histogram.mean(0.05f, 0.95f)) < 0.25f);
    CHECK_FALSE(make_histogram({}).percentile(0.5f));
    CHECK_FALSE(make_histogram(std::vector<Vec3f>(9)).mean(0.0f, 1.0f));
}

TEST_CASE("Histogram: a large picture is looked at in part, evenly") {
    std::vector<Vec3f> pixels;
    for (int y = 0; y < 512; ++y)
        for (int x = 0; x < 512; ++x) pixels.emplace_back(x % 2 == 0 ? 0.5f : 2.0f);
    const LuminanceHistogram histogram = make_histogram(pixels, 1000);
    CHECK(histogram.pixels <= 1000);
    CHECK(histogram.pixels > 900);
    // Both kinds of columns: a step that is even would see one.
    CHECK(std::fabs(*histogram.mean(0.0f, 1.0f)) < 0.3f);
}

TEST_CASE("Automatic exposure: brings the mean to middle gray, whatever a few lamps do") {
    std::vector<Vec3f> pixels(1000, Vec3f{0.045f});  // two stops below
    CHECK(std::fabs(*automatic_exposure(make_histogram(pixels)) - 2.0f) < 0.15f);
    for (std::size_t i = 0; i < 40; ++i) pixels[i] = Vec3f{900.0f};
    CHECK(std::fabs(*automatic_exposure(make_histogram(pixels)) - 2.0f) < 0.15f);
    CHECK_FALSE(automatic_exposure(make_histogram(std::vector<Vec3f>(9))));
}

namespace {

/// The pictures of the fake back end have the radiance of the camera's x.
void brighten(ViewerModel& model, float radiance) {
    CameraDescription camera = model.camera().camera();
    camera.eye.x = radiance;
    model.camera().set(camera);
}

}  // namespace

TEST_CASE("Automatic exposure: off, no frame has values and no histogram is made") {
    ModelBench bench(32);
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.frame() != nullptr && model.frame()->snapshot.passes > 5; }));
    CHECK_FALSE(model.frame()->has_values());
    CHECK(model.exposure().histogram() == nullptr);
    CHECK(model.exposure().times_made() == 0);
    CHECK(model.display().settings() == DisplaySettings{});
}

TEST_CASE("Automatic exposure: settles at middle gray, stays there, and follows a brighter picture") {
    ModelBench bench(32);
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    brighten(model, 0.045f);
    model.exposure().set_on(true);
    const auto is_near = [&](float ev) { return std::fabs(model.display().settings().exposure_ev - ev) < 0.25f; };
    REQUIRE(bench.run_until(model, [&] { return is_near(2.0f); }));
    const auto run_frames = [&](std::uint64_t count) {
        const std::uint64_t before = model.frame()->serial;
        REQUIRE(bench.run_until(model, [&] { return model.frame()->serial > before + count; }));
    };
    run_frames(4);
    const float settled = model.display().settings().exposure_ev;
    run_frames(4);
    CHECK(model.display().settings().exposure_ev == settled);
    brighten(model, 2.88f);
    REQUIRE(bench.run_until(model, [&] { return is_near(-4.0f); }));
    CHECK(model.exposure().is_on());
    // The film is not touched: it begins anew with an edit only.
    CHECK(model.files().pictures().picture().display.exposure_ev == model.display().settings().exposure_ev);
}

TEST_CASE("Automatic exposure: another exposure switches it off") {
    ModelBench bench(32);
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    brighten(model, 0.045f);
    model.exposure().set_on(true);
    REQUIRE(bench.run_until(model, [&] { return model.display().settings().exposure_ev > 1.5f; }));
    model.display().set_exposure(-3.0f);
    model.update(bench.clock += 0.1);
    CHECK_FALSE(model.exposure().is_on());
    CHECK(model.display().settings().exposure_ev == -3.0f);
}
