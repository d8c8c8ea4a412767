#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"

using namespace pl;
using namespace pl::test;

TEST_CASE("Camera motion: motion ends a tenth of a second after the last input") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    model.update(1.0);
    model.camera().look({5.0f, 0.0f});
    CHECK(model.camera().is_moving());
    model.update(1.09);
    CHECK(model.camera().is_moving());
    model.camera().look({5.0f, 0.0f});
    model.update(1.18);
    CHECK(model.camera().is_moving());
    model.update(1.20);
    CHECK_FALSE(model.camera().is_moving());
    CHECK(model.camera().generation() == 2);
}

TEST_CASE("Camera motion: the lens is focused on the picked point") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    model.selection().pick({0.5f, 0.65f});
    REQUIRE(bench.run_until(model, [&] { return model.selection().picked().has_value(); }));
    model.camera().focus_on(model.selection().picked()->position);
    const CameraDescription& camera = model.camera().camera();
    const Vec3f forward = glm::normalize(camera.target - camera.eye);
    CHECK(camera.focus_distance == Approx(glm::dot(model.selection().picked()->position - camera.eye, forward)));
}
