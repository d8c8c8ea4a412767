// The choice between guided passes and those of the baseline, from measurements made up here.
#include "core/session/guiding_choice.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "core/kernel/film/sample_variance.h"
#include "tests/support/catch.hpp"

using namespace pl;

namespace {

constexpr PathCosts kCosts{.segment = 100.0, .guidance = 50.0};

/// 100 paths of two segments each, with this mean variance, and the same relative one where none is given.
PassCounters counters_of(double variance, std::optional<double> relative = std::nullopt, std::uint64_t paths = 100) {
    PassCounters counters;
    const auto sum_of = [&](double value) {
        return static_cast<std::uint64_t>(value * static_cast<double>(paths) * VarianceSums::kSteps);
    };
    counters.paths = paths;
    counters.path.segments = 2 * paths;
    counters.variance = {sum_of(variance), sum_of(relative.value_or(variance)), paths};
    return counters;
}

/// A picture of four times as many pixels as a trial has paths; a field that is mature after `paths` guided paths.
GuidingTerms terms_of(double paths = 64000.0) { return {.costs = kCosts, .pixels = 400.0, .volumes = paths / 640.0}; }

constexpr double kShare = 0.25;  ///< of the smallest trial
constexpr std::uint32_t kBaselineRounds = 6;

/// Runs rounds of the warm-up until it is over; the baseline has variance 1, guided paths that of variance_of(round).
template <class VarianceOf>
std::uint32_t warm_up(GuidingChoice& choice, VarianceOf&& variance_of, const GuidingTerms& terms = terms_of()) {
    std::uint32_t rounds = 0;
    for (; choice.is_warming_up() && rounds < 100; ++rounds) {
        const Trial trial = choice.warm_up_round(terms);
        CHECK(trial.is_guided == (rounds >= (terms.field == GuidingTerms::Field::Learning ? kBaselineRounds : 4)));
        CHECK(trial.is_baseline == !trial.is_guided);
        PassCounters baseline = trial.is_baseline ? counters_of(1.0) : PassCounters{};
        if (rounds < kFewestBeforeVariance) baseline.variance = {};
        choice.measure_round(trial.is_guided ? counters_of(variance_of(rounds)) : PassCounters{}, baseline, terms);
    }
    return rounds;
}

struct Passes {
    std::vector<std::uint32_t> guided;
    std::vector<std::uint32_t> guided_trials;  ///< passes before which they are
    double guided_trial_passes = 0.0;
    std::vector<std::uint32_t> baseline_trials;  ///< likewise
};

/// Runs passes [0, count), whose baseline has variance 1 and guided ones that of variance_of(pass).
template <class VarianceOf>
Passes run(GuidingChoice& choice, std::uint32_t count, VarianceOf&& variance_of,
           const GuidingTerms& terms = terms_of()) {
    Passes passes;
    for (std::uint32_t pass = 0; pass < count; ++pass) {
        const Trial trial = choice.trial_before(pass);
        const double trial_passes = std::max(trial.passes, kShare);
        if (trial.is_guided) {
            passes.guided_trials.push_back(pass);
            passes.guided_trial_passes += trial_passes;
        }
        if (trial.is_baseline) passes.baseline_trials.push_back(pass);
        if (trial.is_due())
            choice.measure_trial(pass,
                                 trial.is_guided
                                     ? counters_of(variance_of(pass), std::nullopt,
                                                   static_cast<std::uint64_t>(trial_passes * terms.pixels))
                                     : PassCounters{},
                                 trial.is_baseline ? counters_of(1.0) : PassCounters{}, terms);
        const bool is_guided = choice.pays();
        if (is_guided) passes.guided.push_back(pass);
        choice.measure_pass(pass, counters_of(is_guided ? variance_of(pass) : 1.0), terms);
    }
    return passes;
}

GuidingChoice beginning() {
    GuidingChoice choice;
    choice.begin_guided();
    return choice;
}

}  // namespace

TEST_CASE("Guiding choice: the cost of a path counts segments and guidance") {
    const auto cost_with = [](double segment_cost) {
        PathEfficiency efficiency;
        efficiency.add(counters_of(1.0), segment_cost);
        return efficiency.cost();
    };
    CHECK(cost_with(kCosts.segment) == Approx(200.0));
    CHECK(cost_with(kCosts.guided_segment()) == Approx(300.0));
}

TEST_CASE("Guiding choice: more triangles, lobes and light samples make guidance a smaller share") {
    const auto share = [](std::size_t triangles, FeatureSet features) {
        const PathCosts costs = PathCosts::of(triangles, features, Representation::Table, true);
        return costs.guidance / costs.segment;
    };
    CHECK(share(12, {}) > share(100, {}));
    CHECK(share(12, {}) > share(12, features(Feature::NextEventEstimation)));
}

TEST_CASE("Guiding choice: what takes more time at a vertex has to gain more") {
    const auto guided = [](Representation representation, bool learns = true) {
        return PathCosts::of(12, features(Feature::NextEventEstimation), representation, learns).guided_segment();
    };
    CHECK(guided(Representation::Table) > guided(Representation::Table, false));
    CHECK(guided(Representation::SdTree) > guided(Representation::Table));
    CHECK(guided(Representation::Lobes) > guided(Representation::SdTree));
    CHECK(guided(Representation::Neural) > guided(Representation::Lobes));
}

TEST_CASE("Guiding choice: a warm-up ends early with a clear gain or a loss") {
    const GuidingTerms learning = terms_of(4000.0);  // with 12 rounds of 100 paths
    const auto rounds_with = [](double variance, const GuidingTerms& terms) {
        GuidingChoice choice;
        const std::uint32_t rounds = warm_up(
            choice, [&](std::uint32_t) { return variance; }, terms);
        REQUIRE(choice.gain());
        CHECK(*choice.gain() == Approx(1.0 / (variance * 1.5)));
        return std::pair(rounds, choice.pays());
    };
    CHECK(rounds_with(0.4, learning) == std::pair(8u, true));    // a gain of 1.67
    CHECK(rounds_with(0.7, learning) == std::pair(8u, true));    // 0.95: fields get better
    CHECK(rounds_with(0.9, learning) == std::pair(12u, false));  // 0.74: it may still
    CHECK(rounds_with(1.0, learning) == std::pair(8u, false));   // 0.67
    CHECK(rounds_with(1.2, learning) == std::pair(8u, false));
    CHECK(rounds_with(1.2, terms_of()) ==
          std::pair(12u, true));  // 0.56: of a field that is still young, nothing is certain
    CHECK(rounds_with(20.0, terms_of()) == std::pair(12u, false));
}

TEST_CASE("Guiding choice: a warm-up goes on while it is neither a gain nor a loss") {
    const auto outcome = [](double first, double fall) {
        GuidingChoice choice;
        const std::uint32_t rounds = warm_up(
            choice, [&](std::uint32_t round) { return first - fall * (round - kBaselineRounds); }, terms_of(4000.0));
        return std::pair(rounds, choice.pays());
    };
    CHECK(outcome(0.755, 0.0) == std::pair(12u, false));  // 0.883
    CHECK(outcome(0.755, 0.01) == std::pair(10u, true));  // 0.9 in the tenth round, as the mean of four
}

// The baseline finds its light too rarely for its variance to be known, as on labyrinth.
TEST_CASE("Guiding choice: a young field that finds light where the baseline does not is never given up") {
    const auto outcome = [](std::uint32_t lit_of_guided, const GuidingTerms& terms) {
        GuidingChoice choice;
        while (choice.is_warming_up()) {
            PassCounters guided = counters_of(1.0);  // a gain of 0.67
            guided.zero_contribution_paths = 100 - lit_of_guided;
            PassCounters baseline = counters_of(1.0);
            baseline.zero_contribution_paths = 90;
            const bool is_guided = choice.warm_up_round(terms).is_guided;
            choice.measure_round(is_guided ? guided : PassCounters{}, is_guided ? PassCounters{} : baseline, terms);
        }
        CHECK(choice.found_hidden_light() == (choice.pays() && lit_of_guided > 15));
        return std::pair(choice.rounds(), choice.pays());
    };
    const GuidingTerms learning = terms_of(4000.0);  // with 12 rounds of 100 paths
    CHECK(outcome(14, learning) == std::pair(8u, false));
    CHECK(outcome(16, learning) == std::pair(12u, true));
    CHECK(outcome(100, learning) == std::pair(12u, true));
    const GuidingTerms mature = terms_of(1000.0);
    CHECK(outcome(100, mature) == std::pair(12u, false));  // its gain is known
}

TEST_CASE("Guiding choice: a field that finds hidden light in a trial is used again") {
    GuidingChoice choice = beginning();
    const GuidingTerms learning = terms_of(4000.0);
    run(
        choice, 12, [](std::uint32_t) { return 20.0; }, learning);
    REQUIRE_FALSE(choice.pays());
    std::uint32_t pass = 12;
    for (; pass < 400 && !choice.pays(); ++pass) {
        PassCounters guided;
        if (choice.trial_before(pass).is_guided) {
            guided = counters_of(3.0);  // a gain of 0.22
            guided.zero_contribution_paths = 20;
            choice.measure_trial(pass, guided, {}, learning);
        }
        PassCounters baseline = counters_of(1.0);
        baseline.zero_contribution_paths = 95;
        if (!choice.pays()) choice.measure_pass(pass, baseline, learning);
    }
    CHECK(choice.pays());
}

TEST_CASE("Guiding choice: the more a field has learned, the more is asked of it") {
    const auto pays_with = [](double variance, const GuidingTerms& terms) {
        GuidingChoice choice;
        warm_up(
            choice, [&](std::uint32_t) { return variance; }, terms);
        return choice.pays();
    };
    // Eight to twelve rounds of 100 paths.
    CHECK(pays_with(1.2, terms_of(8000.0)));        // 0.56, young
    CHECK_FALSE(pays_with(0.9, terms_of(4000.0)));  // learning
    CHECK(pays_with(0.7, terms_of(2000.0)));        // 0.95
    CHECK_FALSE(pays_with(0.7, terms_of(400.0)));   // mature
    CHECK(pays_with(0.6, terms_of(400.0)));         // 1.11
    GuidingTerms complete = terms_of();
    complete.field = GuidingTerms::Field::Complete;
    CHECK_FALSE(pays_with(0.7, complete));
    CHECK(pays_with(0.6, complete));
}

TEST_CASE("Guiding choice: a coarse map is measured in six rounds, and has to gain 0.9") {
    GuidingTerms coarse = terms_of();
    coarse.field = GuidingTerms::Field::Coarse;
    const auto outcome = [&](double variance) {
        GuidingChoice choice;
        const std::uint32_t rounds = warm_up(
            choice, [&](std::uint32_t) { return variance; }, coarse);
        return std::pair(rounds, choice.pays());
    };
    CHECK(outcome(0.4) == std::pair(6u, true));
    CHECK(outcome(0.72) == std::pair(6u, true));   // 0.93
    CHECK(outcome(0.76) == std::pair(6u, false));  // 0.88
    CHECK(outcome(20.0) == std::pair(6u, false));
}

TEST_CASE("Guiding choice: nothing is told before the warm-up is over") {
    GuidingChoice choice;
    for (std::uint32_t round = 0; round < kBaselineRounds; ++round)
        choice.measure_round({}, counters_of(1.0), terms_of());
    CHECK(choice.is_warming_up());
    CHECK_FALSE(choice.gain());
    CHECK(choice.pays());
}

TEST_CASE("Guiding choice: the baseline has two trials before the first decision, then some that cost two per cent") {
    for (const bool warms_up : {false, true}) {
        GuidingChoice choice = warms_up ? GuidingChoice{} : beginning();
        const std::uint32_t rounds = warms_up ? warm_up(choice, [](std::uint32_t) { return 0.4; }) : 0;
        const double guided = rounds > 0 ? rounds - kBaselineRounds : 0.0;
        const double spent = kShare * (rounds + 0.5 * guided);
        const Passes passes = run(choice, 1000, [](std::uint32_t) { return 0.4; });
        CHECK(passes.guided_trials.empty());
        REQUIRE(passes.baseline_trials.size() > 3);
        CHECK(passes.baseline_trials[0] == 3);
        CHECK(passes.baseline_trials[1] == 5);
        CHECK(passes.baseline_trials[2] == Approx((spent + 3 * kShare) / 0.02).margin(1.0));
        CHECK(spent + kShare * static_cast<double>(passes.baseline_trials.size()) == Approx(20.0).margin(1.0));
    }
}

TEST_CASE("Guiding choice: a baseline that is known well has no further trials") {
    GuidingChoice choice = beginning();
    PassCounters many = counters_of(1.0);
    many.variance.samples = 131072;
    many.variance.sum = static_cast<std::uint64_t>(131072 * VarianceSums::kSteps);
    for (const std::uint32_t pass : {3u, 5u}) choice.measure_trial(pass, {}, many, terms_of());
    CHECK(run(choice, 1000, [](std::uint32_t) { return 0.4; }).baseline_trials.empty());
}

TEST_CASE("Guiding choice: a trial is due until it is measured, and one before a pass") {
    GuidingChoice choice = beginning();
    CHECK(choice.trial_before(3) == Trial{.is_baseline = true});
    CHECK(choice.trial_before(3) == Trial{.is_baseline = true});
    choice.measure_trial(3, {}, counters_of(1.0), terms_of());
    CHECK_FALSE(choice.trial_before(3).is_due());
    CHECK_FALSE(choice.gain());
}

TEST_CASE("Guiding choice: guides as long as variance times cost is less") {
    GuidingChoice choice = beginning();
    CHECK(run(choice, 1000, [](std::uint32_t) { return 0.6; }).guided.size() == 1000);
    REQUIRE(choice.gain());
    CHECK(*choice.gain() == Approx(1.0 / (0.6 * 1.5)));
    CHECK(choice.pays());
}

TEST_CASE("Guiding choice: a film that begins guided gives up once its field has had time to learn") {
    const GuidingTerms terms =
        terms_of(6400.0);  // in passes of 100 paths: learning from the 19th on, mature from the 64th
    const auto guided_passes = [&](double variance) {
        GuidingChoice choice = beginning();
        return run(
                   choice, 100, [&](std::uint32_t) { return variance; }, terms)
            .guided.size();
    };
    CHECK(guided_passes(8.0) == 7);     // 0.08
    CHECK(guided_passes(0.9) == 19);    // 0.74
    CHECK(guided_passes(0.7) == 64);    // 0.95
    CHECK(guided_passes(0.63) == 100);  // 1.06
}

// A gain of 1.02 by variance: lens and two-lights, which differ by relative variance.
TEST_CASE("Guiding choice: both variances decide, right after the first measured pass behind a warm-up") {
    const auto guided_passes = [](double relative, bool warms_up) {
        GuidingChoice choice = warms_up ? GuidingChoice{} : beginning();
        constexpr double kVariance = 1.0 / (1.02 * 1.5);
        const GuidingTerms terms = terms_of(100.0);  // mature after a pass
        if (warms_up)
            warm_up(
                choice, [](std::uint32_t) { return 0.6; }, terms);
        std::size_t passes = 0;
        for (std::uint32_t pass = 0; pass < 20; ++pass) {
            const Trial trial = choice.trial_before(pass);
            const PassCounters guided = counters_of(kVariance, relative);
            const PassCounters baseline = counters_of(1.0);
            if (trial.is_due())
                choice.measure_trial(pass, trial.is_guided ? guided : PassCounters{},
                                     trial.is_baseline ? baseline : PassCounters{}, terms);
            const bool is_guided = choice.pays();
            passes += is_guided ? 1 : 0;
            choice.measure_pass(pass, is_guided ? guided : baseline, terms);
        }
        return passes;
    };
    const double more = 1.0 / (0.9 * 1.5);  // a gain of 0.9 by relative variance, 0.96 by both
    const double less = 1.0 / (1.3 * 1.5);  // of 1.3, 1.15 by both
    CHECK(guided_passes(more, false) == 7);
    CHECK(guided_passes(less, false) == 20);
    CHECK(guided_passes(less, true) == 20);
    CHECK(guided_passes(more, true) < 7);
}

TEST_CASE("Guiding choice: without a gain trials cost a few per cent of the time") {
    for (const double variance : {7.0, 20.0}) {
        GuidingChoice choice;
        const double rounds = warm_up(choice, [&](std::uint32_t) { return variance; });
        const Passes passes = run(choice, 2000, [&](std::uint32_t) { return variance; });
        INFO(variance << ": " << passes.guided_trials.size());
        CHECK_FALSE(choice.pays());
        CHECK(passes.guided.empty());
        CHECK(passes.guided_trials.size() > 5);
        const double spent =
            kShare * (kBaselineRounds + 1.5 * (rounds - kBaselineRounds)) + 1.5 * passes.guided_trial_passes;
        CHECK(spent > 0.015 * 2000.0);
        CHECK(spent < 0.021 * 2000.0);
        for (std::size_t i = 1; i < passes.guided_trials.size(); ++i)
            CHECK(passes.guided_trials[i] >= 1.25 * passes.guided_trials[i - 1]);
    }
}

TEST_CASE("Guiding choice: guided paths that were bright by chance in a warm-up have a second look") {
    GuidingChoice choice;
    warm_up(choice, [](std::uint32_t) { return 7.0; });
    REQUIRE_FALSE(choice.pays());
    GuidingChoice unlucky = choice;
    const Passes after = run(unlucky, 6, [](std::uint32_t) { return 0.4; });
    CHECK(after.guided_trials == std::vector<std::uint32_t>{4});
    CHECK(after.guided == std::vector<std::uint32_t>{4, 5});
    CHECK(*unlucky.gain() == Approx(1.0 / (0.4 * 1.5)));  // without the paths of the warm-up
    const Passes loses = run(choice, 20, [](std::uint32_t) { return 7.0; });
    CHECK(loses.guided_trials == std::vector<std::uint32_t>{4});
    CHECK(loses.guided.empty());
}

TEST_CASE("Guiding choice: a field that has become better is used again") {
    GuidingChoice choice;
    warm_up(choice, [](std::uint32_t) { return 7.0; });
    const Passes passes = run(choice, 4000, [](std::uint32_t pass) { return pass < 300 ? 7.0 : 0.2; });
    CHECK(passes.guided.size() > 2000);
    CHECK(choice.pays());
    CHECK(*choice.gain() == Approx(1.0 / (0.2 * 1.5)).epsilon(0.01));
}

TEST_CASE("Guiding choice: passes of the baseline correct a variance that was measured too low") {
    GuidingChoice choice;
    warm_up(choice, [](std::uint32_t) { return 7.0; });
    REQUIRE_FALSE(choice.pays());
    std::uint32_t pass = 0;
    for (; pass < 40 && !choice.pays(); ++pass) choice.measure_pass(pass, counters_of(20.0), terms_of());
    CHECK(choice.pays());
    CHECK(pass < 20);
}

TEST_CASE("Guiding choice: a field without a measurable gain is trusted") {
    // A picture without noise, and a baseline that has found no light.
    for (const double variance : {0.0, 1.0}) {
        GuidingChoice choice;
        for (int round = 0; choice.is_warming_up() && round < 100; ++round)
            choice.measure_round(counters_of(variance), counters_of(0.0), terms_of());
        CHECK_FALSE(choice.is_warming_up());
        CHECK(choice.pays());
        CHECK_FALSE(choice.gain());
    }
}

TEST_CASE("Guiding choice: another film keeps the decision and measures anew") {
    GuidingChoice paid;
    warm_up(paid, [](std::uint32_t) { return 0.4; });
    GuidingChoice again = paid.restarted();
    CHECK_FALSE(again.is_warming_up());
    CHECK_FALSE(again.gain());
    CHECK(run(again, 10, [](std::uint32_t) { return 0.4; }).baseline_trials == std::vector<std::uint32_t>{3, 5});
    CHECK(again.gain());
    GuidingChoice lost;
    warm_up(lost, [](std::uint32_t) { return 7.0; });
    GuidingChoice lost_again = lost.restarted();
    lost_again.trust_field();  // it knows better
    const Passes passes = run(lost_again, 10, [](std::uint32_t) { return 7.0; });
    CHECK(passes.guided.empty());
    CHECK(passes.guided_trials == std::vector<std::uint32_t>{3});
    CHECK(lost_again.gain());
}

TEST_CASE("Guiding choice: a warm-up that another film interrupts counts once the field has learned a little") {
    GuidingChoice choice;
    for (int round = 0; round < 3; ++round) choice.measure_round(counters_of(1.0), {}, terms_of());
    CHECK(choice.restarted().is_warming_up());
    choice.measure_round(counters_of(1.0), counters_of(1.0), terms_of());
    REQUIRE(choice.is_warming_up());
    CHECK_FALSE(choice.restarted().is_warming_up());
    CHECK(choice.restarted().pays());
}
