#include "ui/model/shown_volumes.h"

#include <cmath>

#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Shown volumes: the selected one and the pinned ones, each once, on one scale, now and then") {
    FileBench bench;
    bench.options.settings.method = MethodId::Reinforcement;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    model.time().set_keeps(true);
    REQUIRE(bench.run_until(model, [&] { return model.time().history()->frames.size() >= 3; }));
    CHECK(shown_volumes(model).empty());
    model.selection().pick({0.5f, 0.65f});
    REQUIRE(bench.run_until(model, [&] { return model.selection().inspection() != nullptr; }));
    const std::int32_t selected = model.selection().volume();
    REQUIRE(shown_volumes(model).size() == 1);
    CHECK(shown_volumes(model)[0].color == 0xffffffffu);
    const std::int32_t other = selected == 0 ? 1 : 0;
    CHECK(model.selection().pins().toggle(other));
    model.selection().toggle_pin();
    REQUIRE(bench.run_until(model, [&] { return shown_volumes(model).size() == 2; }));
    std::vector<ShownVolume> shown = shown_volumes(model);
    CHECK(shown[0].volume->volume == other);
    CHECK(shown[0].color == PinnedVolumes::kColors[0]);
    CHECK_FALSE(shown[0].is_selected);
    CHECK(shown[1].volume->volume == selected);
    CHECK(shown[1].color == PinnedVolumes::kColors[1]);
    CHECK(shown[1].is_selected);

    const ValueRange range = shown_range(model, shown);
    for (const ShownVolume& volume : shown)
        for (const float value : cell_values(*volume.volume, model.window().cell_display.quantity))
            CHECK(value <= range.high);

    model.window().cell_display.truth = false;
    CHECK(shown_discs(model, *shown[1].volume).size() == 1);
    model.time().show(0);
    shown = shown_volumes(model);
    const std::vector<ShownDisc> discs = shown_discs(model, *shown[1].volume);
    REQUIRE(discs.size() == 2);
    CHECK(discs[0].caption == "pass " + std::to_string(model.time().history()->frames.front()->passes()));
    CHECK(discs[1].caption == "now");
    const CellQuantity quantity = model.window().cell_display.quantity;
    CHECK(discs[0].values == cell_values(model.time().frame()->inspect(selected), quantity));
    CHECK(discs[1].values == cell_values(*model.selection().inspection(), quantity));
}

TEST_CASE("Shown volumes: the true light has its place before it is known, so that no disc jumps away") {
    FileBench bench;
    bench.options.settings.method = MethodId::Reinforcement;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    model.selection().pick({0.5f, 0.65f});
    REQUIRE(bench.run_until(model, [&] { return model.selection().inspection() != nullptr; }));
    const VolumeInspection& volume = *model.selection().inspection();
    REQUIRE(model.selection().light().report() == nullptr);  // no panel has shown it
    CellDisplay& display = model.window().cell_display;
    for (const CellQuantity quantity : {CellQuantity::Radiance, CellQuantity::Probability, CellQuantity::Density}) {
        display.quantity = quantity;
        const std::vector<ShownDisc> discs = shown_discs(model, volume);
        REQUIRE(discs.size() == 2);
        CHECK(discs[1].caption == (quantity == CellQuantity::Density ? "light x BSDF" : "true"));
        CHECK(discs[1].values.empty());
    }
    display.quantity = CellQuantity::Visits;
    CHECK(shown_discs(model, volume).size() == 1);
    display.quantity = CellQuantity::Radiance;
    display.truth = false;
    CHECK(shown_discs(model, volume).size() == 1);
}

TEST_CASE(
    "Shown volumes: the difference of probabilities is zero for equal ones, and as it should be for two cells") {
    const std::vector<float> even{0.5f, 0.5f};
    const std::vector<float> odd{0.75f, 0.25f};
    CHECK(difference(even, even).divergence == 0.0);
    CHECK(difference(even, even).total_variation == 0.0);
    CHECK(difference(odd, even).total_variation == Approx(0.25));
    CHECK(difference(odd, even).divergence == Approx(0.75 * std::log(1.5) + 0.25 * std::log(0.5)));
    CHECK(std::isinf(difference(even, {1.0f, 0.0f}).divergence));
    CHECK(difference({1.0f, 0.0f}, even).divergence == Approx(std::log(2.0)));
}
