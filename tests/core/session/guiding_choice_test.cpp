// The choice between passes of the method and of the baseline, from measurements made up here.
#include "core/session/guiding_choice.h"

#include <vector>

#include "core/fields/field_model.h"
#include "tests/support/catch.hpp"

using namespace pl;

namespace {

/// 100 paths with this mean variance; `dark` of them bring no light.
PassCounters counters_of(double variance, std::uint64_t dark = 0) {
    PassCounters counters;
    counters.paths = 100;
    counters.zero_contribution_paths = dark;
    counters.variance = {
        static_cast<std::uint64_t>(static_cast<std::int64_t>(100.0 * variance * VarianceSums::kSteps)), 100};
    return counters;
}
/// 100 paths whose variance is not measured.
PassCounters unmeasured() {
    PassCounters counters;
    counters.paths = 100;
    return counters;
}

constexpr double kLeast = 1.28;

/// Runs a warm-up whose paths of the baseline have variance 1, and guided ones this variance.
void warm_up(GuidingChoice& choice, double guided, std::uint64_t dark_of_baseline = 0) {
    for (int i = 0; choice.is_warming_up() && i < 100; ++i)
        choice.measure_warm_up(choice.warm_up_trial() == Trial::Guided ? counters_of(guided)
                                                                       : counters_of(1.0, dark_of_baseline),
                               kLeast);
}

/// Runs the first passes of a film likewise. Returns those that were guided.
std::vector<std::uint32_t> run(GuidingChoice& choice, double guided, std::uint32_t passes = 12) {
    std::vector<std::uint32_t> result;
    for (std::uint32_t pass = 0; pass < passes; ++pass) {
        const Trial trial = choice.trial_before(pass);
        if (trial != Trial::None) choice.measure_trial(pass, counters_of(trial == Trial::Guided ? guided : 1.0));
        if (choice.pays()) result.push_back(pass);
        if (choice.is_measured(pass)) choice.measure_pass(pass, counters_of(choice.pays() ? guided : 1.0), kLeast);
    }
    return result;
}

GuidingChoice beginning() {
    GuidingChoice choice;
    choice.begin_guided();
    return choice;
}

}  // namespace

TEST_CASE("Guiding choice: representations whose guidance takes more time have to gain more") {
    const auto least = [](Representation representation) {
        return GuidingChoice::least_ratio(guidance_of(representation));
    };
    CHECK(least(Representation::Table) == Approx(kLeast));
    CHECK(least(Representation::SdTree) > least(Representation::Table));
    CHECK(least(Representation::Lobes) > least(Representation::SdTree));
    CHECK(least(Representation::Neural) > least(Representation::Lobes));
}

TEST_CASE("Guiding choice: a warm-up makes means by four rounds and measures both methods in four more") {
    GuidingChoice choice;
    std::vector<std::uint32_t> baseline;
    std::vector<std::uint32_t> guided;
    while (choice.is_warming_up()) {
        (choice.warm_up_trial() == Trial::Guided ? guided : baseline).push_back(choice.warm_up_round());
        CHECK_FALSE(choice.variance_ratio());
        choice.measure_warm_up(counters_of(choice.warm_up_trial() == Trial::Guided ? 0.5 : 1.0), kLeast);
    }
    CHECK(baseline == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7});
    CHECK(guided == std::vector<std::uint32_t>{4, 5, 6, 7});
    CHECK(choice.variance_ratio() == Approx(2.0));
    CHECK(choice.pays());
}

TEST_CASE("Guiding choice: the ratio of variances decides, after a warm-up and before pass 8") {
    for (const double ratio : {0.5, 1.0, 1.25, 1.3, 2.0, 30.0}) {
        INFO(ratio);
        GuidingChoice warm;
        warm_up(warm, 1.0 / ratio);
        CHECK(warm.pays() == (ratio > kLeast));
        CHECK(warm.variance_ratio() == Approx(ratio));
        CHECK_FALSE(warm.found_hidden_light());

        GuidingChoice small = beginning();
        const std::size_t guided = run(small, 1.0 / ratio).size();
        CHECK(guided == (ratio > kLeast ? 12 : 8));
        CHECK(small.variance_ratio() == Approx(ratio));
    }
}

TEST_CASE(
    "Guiding choice: a film decides once more, soon if it is guided, else when that costs little beside its passes") {
    GuidingChoice lucky;
    warm_up(lucky, 0.2);
    CHECK(run(lucky, 1.0, 100) == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7});
    GuidingChoice unlucky;
    warm_up(unlucky, 1.0);
    CHECK(run(unlucky, 0.2, 68) == std::vector<std::uint32_t>{64, 65, 66, 67});
    GuidingChoice restarted = unlucky.restarted();
    CHECK(restarted.pays());
    CHECK(run(restarted, 1.0, 100) == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7});
    CHECK(run(restarted = restarted.restarted(), 0.2, 10) == std::vector<std::uint32_t>{8, 9});
}

TEST_CASE(
    "Guiding choice: the four passes before a decision have a trial of the method that they do not use, once each") {
    for (const bool pays : {true, false}) {
        GuidingChoice choice;
        warm_up(choice, pays ? 0.2 : 1.0);
        const std::uint32_t decision = pays ? 8 : 64;
        for (std::uint32_t pass = 0; pass < 100; ++pass) {
            const Trial due = choice.trial_before(pass);
            const bool is_measured = pass >= decision - 4 && pass < decision;
            CHECK(due == (!is_measured ? Trial::None : pays ? Trial::Baseline : Trial::Guided));
            CHECK(choice.is_due_before(pass) == (pass == 0 || (pass >= decision - 4 && pass <= decision)));
            if (due == Trial::None) continue;
            choice.measure_trial(pass, counters_of(1.0));
            CHECK(choice.trial_before(pass) == Trial::None);
        }
    }
}

TEST_CASE("Guiding choice: guiding pays where it finds light that the baseline does not, whatever the variances") {
    for (const auto& [dark, finds] :
         {std::pair{0, false}, std::pair{45, false}, std::pair{55, true}, std::pair{95, true}}) {
        INFO(dark);
        GuidingChoice choice;
        warm_up(choice, 5.0, static_cast<std::uint64_t>(dark));
        CHECK(choice.pays() == finds);
        CHECK(choice.found_hidden_light() == finds);
    }
}

TEST_CASE("Guiding choice: without a measurable variance the belief stays") {
    for (const double guided : {0.0, -1.0}) {
        GuidingChoice choice = beginning();
        CHECK(run(choice, guided).size() == 12);
        CHECK_FALSE(choice.variance_ratio());
        GuidingChoice warm;
        warm_up(warm, guided);
        CHECK(warm.pays());
    }
    GuidingChoice dark;
    while (dark.is_warming_up()) dark.measure_warm_up(unmeasured(), kLeast);
    CHECK(dark.pays());
    CHECK_FALSE(dark.variance_ratio());
}

TEST_CASE("Guiding choice: another film keeps the belief and measures anew") {
    for (const double guided : {0.2, 1.0}) {
        GuidingChoice choice;
        warm_up(choice, guided);
        GuidingChoice again = choice.restarted();
        CHECK_FALSE(again.is_warming_up());
        CHECK(again.pays() == choice.pays());
        CHECK_FALSE(again.variance_ratio());
        run(again, 0.5);
        CHECK(again.pays());
    }
}

TEST_CASE("Guiding choice: a warm-up that another film interrupts is not begun again once it has measured") {
    GuidingChoice choice;
    for (int trials = 0; trials < 6; ++trials) {
        CHECK(choice.restarted().is_warming_up() == (trials < 4));
        CHECK(choice.restarted().pays());
        choice.measure_warm_up(counters_of(1.0), kLeast);
    }
}

TEST_CASE("Guiding choice: every value of its state is visited") {
    GuidingChoice choice;
    for (int trials = 0; trials < 6; ++trials) choice.measure_warm_up(counters_of(0.5, 10), kLeast);
    GuidingChoice copy;
    std::vector<double> values;
    const auto as_number = [](const auto& value) {
        if constexpr (requires { value.has_value(); })
            return value ? static_cast<double>(*value) : -1.0;
        else
            return static_cast<double>(value);
    };
    GuidingChoice::each_value(choice, [&](const auto& value) { values.push_back(as_number(value)); });
    CHECK(values.size() == 14);
    std::size_t next = 0;
    GuidingChoice::each_value(copy, [&](auto& value) {
        const double from = values[next++];
        if constexpr (requires { value.has_value(); }) {
            if (from >= 0.0) value = static_cast<typename std::remove_cvref_t<decltype(value)>::value_type>(from);
        } else {
            value = static_cast<std::remove_cvref_t<decltype(value)>>(from);
        }
    });
    warm_up(choice, 0.7);
    warm_up(copy, 0.7);
    CHECK(copy.variance_ratio() == choice.variance_ratio());
    CHECK(copy.pays() == choice.pays());
}
