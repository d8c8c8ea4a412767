// The marks of gains by tiles: measured only while they are shown, of two pictures that are there.
#include "ui/model/gain_marks.h"

#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"
#include "ui/input/perform_action.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Gain marks: they need both pictures, say so, and go with the picture") {
    FileBench bench;
    bench.options.settings.method = MethodId::Reinforcement;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model) && model.status().passes >= 2; }));
    GainMarks& marks = model.gain_marks();
    CHECK(marks.gains() == nullptr);
    CHECK(marks.reason().empty());

    perform(model, ActionId::ShowGain);
    REQUIRE(bench.run_until(model, [&] { return !marks.reason().empty(); }));
    CHECK(marks.reason() == "Default has no picture to compare with yet");
    CHECK(marks.gains() == nullptr);

    model.comparison().set_turns(true);
    double seconds = 0.0;
    REQUIRE(bench.run_until(model, [&] {
        model.update(seconds += 1.0);
        return marks.gains() != nullptr;
    }));
    CHECK(marks.gains()->tiles.size() == 16);  // 64 x 64 pixels
    CHECK(marks.method() == MethodId::Reinforcement);
    CHECK(marks.reason().empty());

    // Another camera shows another picture.
    const std::uint64_t picture = model.status().picture;
    CameraDescription camera = model.camera().camera();
    camera.fov_deg *= 0.9f;
    model.camera().set(camera);
    REQUIRE(bench.run_until(model, [&] { return model.status().picture != picture; }));
    model.comparison().set_turns(false);
    model.cancel();  // Esc
    CHECK_FALSE(marks.is_shown());
    CHECK(marks.gains() == nullptr);
    for (int i = 0; i < 5; ++i) model.update(seconds += 10.0);
    CHECK(marks.gains() == nullptr);
}
