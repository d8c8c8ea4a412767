#include "ui/model/pinned_volumes.h"

#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Pins: four places, each with its color, until a volume is unpinned") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    PinnedVolumes& pins = model.selection().pins();
    for (const std::int32_t volume : {7, 3, 9, 1}) CHECK(pins.toggle(volume));
    CHECK_FALSE(pins.toggle(5));
    CHECK(pins.contains(9));
    CHECK_FALSE(pins.contains(kNoVolume));
    CHECK(pins.toggle(3));
    CHECK(pins.toggle(5));
    CHECK(pins.places() == std::array<std::int32_t, 4>{7, 5, 9, 1});  // the others keep their colors
    pins.clear();
    CHECK_FALSE(pins.contains(7));
}

TEST_CASE("Pins: frames carry the pinned volumes beside the selected one, and a new field drops them") {
    FileBench bench;
    bench.options.settings.method = MethodId::Reinforcement;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    model.selection().toggle_pin();
    CHECK(told(model, "click a surface first"));
    model.selection().pick({0.5f, 0.65f});
    REQUIRE(bench.run_until(model, [&] { return model.selection().inspection() != nullptr; }));
    const std::int32_t first = model.selection().volume();
    model.selection().toggle_pin();
    const std::int32_t other = first == 0 ? 1 : 0;
    CHECK(model.selection().pins().toggle(other));
    REQUIRE(bench.run_until(model, [&] { return model.frame()->pins.size() == 2; }));
    CHECK(model.frame()->pins[0]->volume == first);
    CHECK(model.frame()->pins[1]->volume == other);
    CHECK(model.frame()->pins[1]->side > 0);

    FieldSettings field = model.render().settings().field;
    field.bins = 64;
    model.render().set_field(field);
    CHECK_FALSE(model.selection().pins().contains(first));
    REQUIRE(bench.run_until(model, [&] { return model.frame()->pins.empty(); }));
}
