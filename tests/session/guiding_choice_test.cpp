// The choice between guided passes and those of the baseline, from measurements made up here.
#include "core/session/guiding_choice.h"

#include "tests/support/catch.hpp"

using namespace pl;

namespace {

constexpr PathCosts kCosts{.segment = 100.0, .guidance = 50.0};

/// 100 paths of two segments each, with this mean variance.
PassCounters counters_of(double variance, bool is_guided) {
    PassCounters counters;
    counters.paths = 100;
    counters.path.segments = 200;
    counters.path.method.lookups = is_guided ? 200 : 0;
    counters.variance.samples = 100;
    counters.variance.sum = static_cast<std::uint64_t>(variance * 100.0 * VarianceSums::kSteps);
    return counters;
}

/// Runs passes [0, count), whose baseline has variance 1 and guided ones that of variance_of(pass). Returns the guided ones.
template <class VarianceOf>
std::vector<std::uint32_t> run(GuidingChoice& choice, std::uint32_t count, VarianceOf&& variance_of) {
    std::vector<std::uint32_t> guided;
    for (std::uint32_t pass = 0; pass < count; ++pass) {
        if (choice.is_trial_due(pass)) choice.measure_trial(counters_of(1.0, false));
        if (choice.guides(pass)) {
            guided.push_back(pass);
            choice.measure_guided(pass, counters_of(variance_of(pass), true), kCosts);
        } else {
            choice.measure_unguided(counters_of(1.0, false));
        }
    }
    return guided;
}

}  // namespace

TEST_CASE("Guiding choice: the cost of a path counts segments and guidance") {
    CHECK(kCosts.of_path(counters_of(1.0, false)) == Approx(200.0));
    CHECK(kCosts.of_path(counters_of(1.0, true)) == Approx(300.0));
    CHECK(kCosts.of_path({}) == 0.0);
}

TEST_CASE("Guiding choice: more triangles, lobes and light samples make guidance a smaller share") {
    const auto share = [](std::size_t triangles, FeatureSet features) {
        const PathCosts costs = PathCosts::of(triangles, features);
        return costs.guidance / costs.segment;
    };
    CHECK(share(12, {}) > share(100, {}));
    CHECK(share(12, {}) > share(12, features(Feature::NextEventEstimation)));
}

TEST_CASE("Guiding choice: two trials before the first decision, never again") {
    GuidingChoice choice;
    std::vector<std::uint32_t> due;
    for (std::uint32_t pass = 0; pass < 100; ++pass)
        if (choice.is_trial_due(pass)) {
            due.push_back(pass);
            CHECK(choice.is_trial_due(pass));  // until it is complete
            choice.measure_trial(counters_of(1.0, false));
        }
    CHECK(due == std::vector<std::uint32_t>{3, 5});
    CHECK_FALSE(choice.gain());
}

TEST_CASE("Guiding choice: guides as long as variance times cost is less") {
    GuidingChoice choice;
    CHECK(run(choice, 1000, [](std::uint32_t) { return 0.6; }).size() == 1000);
    REQUIRE(choice.gain());
    CHECK(*choice.gain() == Approx(1.0 / (0.6 * 1.5)));
    CHECK(choice.pays());
}

TEST_CASE("Guiding choice: without a gain it loses a few per cent of the time, and still learns") {
    for (const double variance : {0.8, 1.0, 2.0}) {
        GuidingChoice choice;
        const auto guided = run(choice, 2000, [&](std::uint32_t) { return variance; });
        INFO(variance << ": " << guided.size());
        CHECK_FALSE(choice.pays());
        CHECK(guided.size() > 8);
        // Samples of equal weight: time and variance of all passes, over those of as many of the baseline.
        const double share = static_cast<double>(guided.size()) / 2000.0;
        CHECK((1.0 + 0.5 * share) * (1.0 + (variance - 1.0) * share) < 1.03);
    }
}

TEST_CASE("Guiding choice: a field that has become better is used again") {
    GuidingChoice choice;
    const auto guided = run(choice, 4000, [](std::uint32_t pass) { return pass < 300 ? 0.8 : 0.2; });
    CHECK(guided.size() > 2000);
    CHECK(choice.pays());
    CHECK(*choice.gain() == Approx(1.0 / (0.2 * 1.5)).epsilon(0.01));
}

TEST_CASE("Guiding choice: a film without a measurable variance stays guided") {
    GuidingChoice choice;
    choice.measure_trial(counters_of(0.0, false));
    for (std::uint32_t pass = 0; pass < 50; ++pass) {
        CHECK(choice.guides(pass));
        choice.measure_guided(pass, counters_of(0.0, true), kCosts);
    }
    CHECK_FALSE(choice.gain());
}
