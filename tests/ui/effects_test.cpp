// Effects in the window: which are needed and why, forcing them, and measuring what they cost on the running picture.
#include <algorithm>

#include "tests/support/catch.hpp"
#include "tests/ui/worker_bench.h"
#include "ui/effects_model.h"
#include "ui/viewer_model.h"

using namespace pl;
using namespace pl::test;

namespace {

/// What the render thread publishes of a scene in which a mirror was made of the floor.
std::shared_ptr<PublishedFrame> frame_of_mirror() {
    auto scene = std::make_shared<SceneDescription>(*small_scene());
    scene->materials[0].kind = SurfaceKind::Conductor;
    auto frame = std::make_shared<PublishedFrame>();
    frame->description = scene;
    frame->scene = std::make_shared<const HostScene>(pack_scene(*scene));
    frame->backend.name = "cpu";
    return frame;
}

EffectCost cost_of(const EffectsModel& model, FeatureSet forced, std::size_t pairs) {
    EffectCost cost{
        .forced = forced, .base_kernel = model.kernel(), .kernel = model.kernel_with(forced), .result = {}};
    cost.result.pairs = pairs;
    return cost;
}

}  // namespace

TEST_CASE("Effects: what is needed has a reason, and the rest a kernel that would serve it") {
    const auto frame = frame_of_mirror();
    EffectsModel model;
    CHECK(model.rows().empty());
    model.update(*frame, std::nullopt);
    REQUIRE(model.rows().size() == std::size(kAllFeatures));
    for (const EffectRow& row : model.rows()) {
        INFO(row.name);
        CHECK(row.needed() == (row.feature == Feature::Specular));
        CHECK(row.kernel == model.kernel_with(row.with()));
        CHECK((row.kernel == model.kernel()) == (kCompiledSets[3].has(row.feature)));
    }
    const auto specular = std::ranges::find(model.rows(), "specular", &EffectRow::name);
    REQUIRE(specular != model.rows().end());
    CHECK(specular->reason == "of 1 material: floor");
}

TEST_CASE("Effects: a cost is that of a kernel, and is forgotten where it was not measured") {
    const auto frame = frame_of_mirror();
    EffectsModel model;
    model.update(*frame, std::nullopt);
    model.update(*frame, cost_of(model, kEveryFeature, 7));
    REQUIRE(model.cost_of(kEveryFeature) != nullptr);
    CHECK(model.cost_of(features(Feature::Textures)) == model.cost_of(kEveryFeature));
    CHECK(model.cost_of({}) == nullptr);
    model.update(*frame, cost_of(model, kEveryFeature, 9));
    CHECK(model.cost_of(kEveryFeature)->result.pairs == 9);
    frame->settings.width = 99;
    model.update(*frame, std::nullopt);
    CHECK(model.cost_of(kEveryFeature) == nullptr);
    EffectCost foreign = cost_of(model, kEveryFeature, 3);
    foreign.base_kernel = "cpu/default/other";
    model.update(*frame, foreign);
    CHECK(model.cost_of(kEveryFeature) == nullptr);
}

TEST_CASE("Effects: a trial measures passes in turns, and what was forced comes back") {
    Bench bench;
    bench.control->pass_microseconds = 200;
    WorkerSetup setup = bench.setup();
    setup.settings.forced_effects = features(Feature::Rough);
    RenderWorker worker(std::move(setup));
    worker.measure_effects(kEveryFeature);
    REQUIRE(eventually([&] {
        const auto cost = worker.status().effect_cost;
        return cost && cost->done;
    }));
    const EffectCost cost = *worker.status().effect_cost;
    CHECK(cost.forced == kEveryFeature);
    CHECK(cost.result.pairs == PairedCost::kPairs);
    CHECK(cost.result.base_seconds > 150e-6);
    CHECK(cost.result.ratio.low < cost.result.ratio.high);
    const auto served = [&] {
        const std::lock_guard lock(bench.control->mutex);
        return bench.control->served;
    };
    CHECK(std::ranges::count(served(), kEveryFeature) >= static_cast<std::ptrdiff_t>(PairedCost::kPairs));
    CHECK(std::ranges::count(served(), FeatureSet{}) >= static_cast<std::ptrdiff_t>(PairedCost::kPairs));
    worker.measure_effects(std::nullopt);
    REQUIRE(eventually([&] { return !worker.status().effect_cost.has_value(); }));
    const std::uint32_t passes = worker.status().passes;
    REQUIRE(eventually([&] { return worker.status().passes > passes + 1; }));
    CHECK(served().back() == features(Feature::Rough));
    CHECK(worker.latest()->settings.forced_effects == features(Feature::Rough));
}

TEST_CASE("Effects: a trial rests while the camera moves, begins again after it, and turns end it") {
    Bench bench;
    bench.control->pass_microseconds = 2000;
    RenderWorker worker(bench.setup());
    worker.measure_effects(kEveryFeature);
    REQUIRE(eventually([&] {
        const auto cost = worker.status().effect_cost;
        return cost && cost->result.pairs >= 2;
    }));
    worker.submit(EditCamera{camera_at(2.0f)});
    REQUIRE(eventually([&] { return worker.status().effect_cost->result.pairs < 2; }));
    REQUIRE(eventually([&] { return worker.status().effect_cost->result.pairs >= 2; }));
    worker.set_turns(TurnMethods{MethodId::Default, MethodId::Reinforcement});
    REQUIRE(eventually([&] { return worker.status().turns && !worker.status().effect_cost; }));
    worker.measure_effects(kEveryFeature);
    const std::uint32_t passes = worker.status().passes;
    REQUIRE(eventually([&] { return worker.status().passes > passes + 2; }));
    CHECK_FALSE(worker.status().effect_cost.has_value());
}

TEST_CASE("Effects: forcing one empties no picture, and a run says that it was forced") {
    Bench bench;
    bench.control->pass_microseconds = 200;
    RenderWorker worker(bench.setup());
    REQUIRE(eventually([&] { return worker.status().passes >= 4; }));
    const std::uint32_t passes = worker.status().passes;
    worker.submit(EditEffects{kEveryFeature});
    REQUIRE(eventually([&] { return worker.status().passes > passes + 2; }));
    CHECK(eventually([&] {
        const auto runs = worker.runs()->runs;
        return runs.size() == 1 && runs[0]->label.details == "effects forced";
    }));
}
