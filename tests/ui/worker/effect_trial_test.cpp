#include "ui/worker/effect_trial.h"

#include <algorithm>

#include "tests/support/catch.hpp"
#include "tests/ui/worker/session_bench.h"
#include "tests/ui/worker_bench.h"

using namespace pl;
using namespace pl::test;

TEST_CASE("Effects: a trial forces its effects in every second pass, only of whole pictures") {
    SessionBench bench;
    EffectTrial trial(features(Feature::Rough));
    CHECK(trial.matches(std::nullopt));
    CHECK_FALSE(trial.cost());
    trial.settle(bench.session, kEveryFeature);
    CHECK(trial.matches(kEveryFeature));
    const auto forced_in_pass = [&](bool is_whole) {
        trial.begin_pass(bench.session, kDefault, is_whole);
        const FeatureSet forced = bench.session.settings().forced_effects;
        trial.end_pass(bench.session, kDefault, "cpu", bench.session.advance(kDefault));
        return forced;
    };
    CHECK(forced_in_pass(false) == features(Feature::Rough));
    CHECK(forced_in_pass(true) == FeatureSet{});  // the first pass only identifies the film
    const FeatureSet first = forced_in_pass(true);
    const FeatureSet second = forced_in_pass(true);
    CHECK((first == kEveryFeature) != (second == kEveryFeature));
    CHECK(trial.cost()->result.pairs == 0);  // the first pair is a warm-up
    trial.settle(bench.session, std::nullopt);
    CHECK(bench.session.settings().forced_effects == features(Feature::Rough));
}

TEST_CASE("Effects: a trial measures passes in turns, and the forced effects of before return") {
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
    const EffectTrialCost cost = *worker.status().effect_cost;
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
