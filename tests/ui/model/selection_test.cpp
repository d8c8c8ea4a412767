#include "ui/model/selection.h"

#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"
#include "ui/script/script_values.h"

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

TEST_CASE("Pins: frames carry the pinned volumes beside the selected one, and they are found again in a new field") {
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
    REQUIRE(bench.run_until(model, [&] {
        return model.frame()->pins.size() >= 1 && model.frame()->pins[0]->side == 8 &&
               model.selection().pins().contains(model.selection().volume());
    }));
}

TEST_CASE(
    "Selection: a picked volume is selected, deselected, and found again in another field and another placement") {
    FileBench bench;
    bench.options.settings.method = MethodId::Reinforcement;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    model.selection().pick({0.5f, 0.65f});
    REQUIRE(bench.run_until(model, [&] { return model.selection().inspection() != nullptr; }));
    CHECK(model.selection().volume() != kNoVolume);
    CHECK(script_value(model, "inspected") == "yes");
    model.cancel();
    CHECK(model.selection().volume() == kNoVolume);
    CHECK(model.selection().inspection() == nullptr);

    model.selection().pick({0.5f, 0.65f});
    REQUIRE(bench.run_until(model, [&] { return model.selection().inspection() != nullptr; }));
    FieldSettings field = model.render().settings().field;
    field.bins = 64;
    field.volumes = 200;
    model.render().set_field(field);
    const auto shows = [&](int side) {
        const VolumeInspection* const volume = model.selection().inspection();
        return volume != nullptr && volume->side == side;
    };
    REQUIRE(bench.run_until(model, [&] { return shows(8) && model.selection().volume() >= 16; }));
    // A number that the field after it does not have.
    field.bins = 16;
    field.volumes = 16;
    model.render().set_field(field);
    REQUIRE(bench.run_until(model, [&] { return shows(4) && model.selection().volume() < 16; }));
    CHECK(model.selection().picked());
    model.selection().deselect();

    model.selection().pick({0.01f, 0.01f});
    REQUIRE(bench.run_until(model, [&] { return !model.messages().toasts().empty(); }));
    CHECK_THAT(model.messages().toasts().back().text, contains("nothing to select"));
}

TEST_CASE("Selection: Esc before the answer to a click takes the click back") {
    FileBench bench;
    bench.options.settings.method = MethodId::Reinforcement;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    bench.control->hold = true;
    REQUIRE(bench.run_until(model, [&] { return bench.control->inside.load(); }));
    model.selection().pick({0.5f, 0.65f});
    model.cancel();
    bench.control->hold = false;
    const int passes = bench.control->passes;
    REQUIRE(bench.run_until(model, [&] { return bench.control->passes > passes + 2; }));
    CHECK(model.selection().volume() == kNoVolume);
    CHECK_FALSE(model.selection().picked());

    model.selection().pick({0.5f, 0.65f});
    REQUIRE(bench.run_until(model, [&] { return model.selection().volume() != kNoVolume; }));
}
