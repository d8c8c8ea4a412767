// The exposure that follows the picture: it settles, never touches the film, and costs nothing while it is off.
#include <cmath>

#include "tests/support/catch.hpp"
#include "tests/ui/model_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

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
