// The choice between passes of the method and of the baseline, from measurements made up here.
#include "core/session/guiding_choice.h"

#include <cmath>
#include <vector>

#include "core/fields/field_model.h"
#include "tests/support/catch.hpp"

using namespace pl;

namespace {

std::int64_t steps_of(double variance) { return static_cast<std::int64_t>(variance * VarianceSums::kSteps); }

/// 100 paths with this mean variance, measured against training samples of variance 1; `dark` of them bring no light.
PassCounters counters_of(double variance, std::uint64_t dark = 0) {
    PassCounters counters;
    counters.paths = 100;
    counters.zero_contribution_paths = dark;
    for (int i = 0; i < 100; ++i) counters.variance.add(steps_of(variance), steps_of(1.0));
    return counters;
}

/// 100 paths that are not measured.
PassCounters unmeasured(std::uint64_t dark = 0) {
    PassCounters counters = counters_of(0.0, dark);
    counters.variance = {};
    return counters;
}

constexpr double kLeast = 1.36;  // of a table, after a warm-up
constexpr double kLeastLater = 1.6;
constexpr double kTable = 1.0;               // guidance
constexpr std::uint32_t kLarge = 65536;      // pixels: one pass of each role
constexpr std::uint32_t kSmall = 128 * 128;  // two

GuidingChoice beginning(std::uint32_t pixels, bool is_known = false) {
    GuidingChoice choice;
    choice.begin_film(pixels, is_known);
    return choice;
}

/// Runs passes of a film from `first` on; paths of the baseline have variance 1, and guided ones this variance.
void run(GuidingChoice& choice, double guided, std::uint32_t passes, std::uint32_t first = 0,
         std::uint64_t dark_of_baseline = 0) {
    for (std::uint32_t pass = first; pass < first + passes; ++pass)
        choice.finish_pass(pass,
                           choice.role_of(pass) == PassRole::Training ? unmeasured(dark_of_baseline)
                           : choice.is_guided(pass)                   ? counters_of(guided)
                                                                      : counters_of(1.0, dark_of_baseline),
                           kTable);
}

std::vector<PassRole> roles(const GuidingChoice& choice, std::uint32_t passes) {
    std::vector<PassRole> result;
    for (std::uint32_t pass = 0; pass < passes; ++pass) result.push_back(choice.role_of(pass));
    return result;
}

/// The passes that are measured in a film whose choice stays.
std::vector<std::uint32_t> measured(const GuidingChoice& choice, std::uint32_t passes) {
    std::vector<std::uint32_t> result;
    for (std::uint32_t pass = 0; pass < passes; ++pass)
        if (choice.measure_of(pass).is_any) result.push_back(pass);
    return result;
}

}  // namespace

TEST_CASE("Guiding choice: representations whose guidance takes more time have to gain more") {
    const auto least = [](Representation representation) {
        return GuidingChoice::least_ratio(guidance_of(representation), true);
    };
    CHECK(least(Representation::Table) == Approx(kLeast));
    CHECK(GuidingChoice::least_ratio(guidance_of(Representation::Table), false) == Approx(kLeastLater));
    CHECK(least(Representation::SdTree) > least(Representation::Table));
    CHECK(least(Representation::Lobes) > least(Representation::SdTree));
    CHECK(least(Representation::Neural) > least(Representation::Lobes));
}

TEST_CASE("Guiding choice: a film of an unknown field begins with passes that train and guided ones") {
    using enum PassRole;
    CHECK(roles(beginning(kLarge), 4) == std::vector{Training, Guided, None, None});
    CHECK(roles(beginning(kSmall), 6) == std::vector{Training, Training, Guided, Guided, None, None});
    CHECK(beginning(64).schedule().warm_up == 4);
    CHECK(beginning(8'000'000).schedule().warm_up == 2);
    CHECK(beginning(kLarge, true).schedule().warm_up == 0);
    CHECK(roles(beginning(kLarge, true), 4) == std::vector(4, None));
}

TEST_CASE("Guiding choice: roles, weights and the measured samples do not depend on what is measured") {
    for (const std::uint32_t pixels : {kLarge, kSmall}) {
        GuidingChoice paying = beginning(pixels);
        GuidingChoice losing = beginning(pixels);
        for (std::uint32_t pass = 0; pass < 300; ++pass) {
            INFO(pixels << " pixels, pass " << pass);
            CHECK((paying.role_of(pass) == PassRole::None) == (losing.role_of(pass) == PassRole::None));
            CHECK(paying.schedule().weight_of(pass) == losing.schedule().weight_of(pass));
            CHECK(paying.measure_of(pass).is_any == losing.measure_of(pass).is_any);
            run(paying, 0.2, 1, pass);
            run(losing, 1.0, 1, pass);
        }
        CHECK(paying.pays());
        CHECK_FALSE(losing.pays());
    }
}

TEST_CASE("Guiding choice: passes of a warm-up, and of the other method in a question, weigh less") {
    const GuidingChoice choice = beginning(kLarge);
    for (std::uint32_t pass = 0; pass < 600; ++pass) {
        const bool is_other = pass == 128 || pass == 512;
        INFO(pass);
        CHECK(choice.schedule().weight_of(pass) == (pass == 0 || is_other ? 1u : pass == 1 ? 4u : 8u));
        CHECK(choice.is_guided(pass) == (pass > 0 && !is_other));
    }
}

TEST_CASE("Guiding choice: both methods are measured in a warm-up and in every question") {
    CHECK(measured(beginning(kLarge), 600) == std::vector<std::uint32_t>{1, 128, 129, 512, 513});
    CHECK(measured(beginning(kSmall), 160) == std::vector<std::uint32_t>{2, 3, 128, 129, 130, 131});
    CHECK(measured(beginning(kLarge, true), 140) == std::vector<std::uint32_t>{8, 9, 128, 129});
    CHECK(beginning(kSmall).measure_of(2).training == 2);
    CHECK(beginning(kLarge).measure_of(1).training == 1);
    CHECK(beginning(kLarge).measure_of(128).training == 0);
}

TEST_CASE("Guiding choice: the ratio of variances decides after a warm-up") {
    for (const std::uint32_t pixels : {kLarge, kSmall})
        for (const double ratio : {0.5, 1.0, 1.3, 1.4, 2.0, 30.0}) {
            INFO(ratio);
            GuidingChoice choice = beginning(pixels);
            run(choice, 1.0 / ratio, choice.schedule().warm_up - 1);
            CHECK_FALSE(choice.variance_ratio());
            run(choice, 1.0 / ratio, 1, choice.schedule().warm_up - 1);
            CHECK(choice.pays() == (ratio > kLeast));
            CHECK(choice.is_guided(choice.schedule().warm_up) == (ratio > kLeast));
            CHECK(choice.variance_ratio() == Approx(ratio));
        }
}

TEST_CASE(
    "Guiding choice: a question is a pass by the other method and one by the method, and may change the choice") {
    GuidingChoice lucky = beginning(kLarge);
    run(lucky, 0.2, 2);
    CHECK(lucky.role_of(128) == PassRole::Baseline);
    CHECK_FALSE(lucky.is_guided(128));
    CHECK(lucky.role_of(129) == PassRole::Guided);
    run(lucky, 1.0, 128, 2);
    CHECK_FALSE(lucky.pays());
    CHECK(lucky.role_of(512) == PassRole::Guided);
    run(lucky, 0.2, 384, 130);
    CHECK(lucky.pays());
    for (const double ratio : {1.5, 1.7}) {
        GuidingChoice choice = beginning(kLarge);
        run(choice, 1.0 / ratio, 130);
        CHECK(choice.pays() == (ratio > kLeastLater));
    }
    // Of a film without a warm-up the first question is early.
    GuidingChoice moved = lucky.restarted();
    moved.begin_film(kLarge, true);
    CHECK(moved.schedule().warm_up == 0);
    CHECK(moved.pays());
    CHECK_FALSE(moved.variance_ratio());
    run(moved, 1.0, 10);
    CHECK_FALSE(moved.pays());
    GuidingChoice again = moved.restarted();
    again.begin_film(kLarge, true);
    CHECK_FALSE(again.is_guided(0));
    CHECK(again.is_guided(8));
}

TEST_CASE("Guiding choice: guiding pays where it finds light that the baseline does not, whatever the variances") {
    for (const auto& [dark, finds] :
         {std::pair{0, false}, std::pair{45, false}, std::pair{55, true}, std::pair{95, true}}) {
        INFO(dark);
        GuidingChoice choice = beginning(kLarge);
        run(choice, 5.0, 2, 0, static_cast<std::uint64_t>(dark));
        CHECK(choice.pays() == finds);
    }
}

// Pixels whose guided sample has variance 1 or 3 and whose training sample varies by `training` in step with it, or against it: the ratio of
// means is 1 in both cases, and errs where both do not move together. 100 pixels: a relative standard error of 0.05 of each mean.
TEST_CASE("Guiding choice: the ratio of variances has an interval, by which both variances of a pixel err together") {
    const auto factor = [](std::uint32_t pixels, double low, double high) {
        PassCounters counters;
        counters.paths = 100;
        for (int i = 0; i < 50; ++i) {
            counters.variance.add(steps_of(1.0), steps_of(low));
            counters.variance.add(steps_of(3.0), steps_of(high));
        }
        GuidingChoice choice = beginning(pixels);
        const std::uint32_t each = choice.schedule().each;
        for (std::uint32_t pass = 0; pass < 2 * each; ++pass)
            choice.finish_pass(pass, pass < each ? unmeasured() : counters, kTable);
        CHECK(choice.variance_ratio() == Approx(1.0));
        return choice.ratio_factor();
    };
    CHECK(factor(kLarge, 1.0, 3.0) == Approx(1.0));
    CHECK(factor(kLarge, 2.0, 2.0) == Approx(std::exp(1.96 * 0.05)));
    CHECK(factor(kLarge, 3.0, 1.0) == Approx(std::exp(1.96 * 0.1)));
    // Two guided samples of a pixel against the same training samples tell no more than one.
    CHECK(factor(kSmall, 2.0, 2.0) == Approx(std::exp(1.96 * 0.05)));
    // A question: both variances have passes of their own.
    GuidingChoice choice = beginning(kLarge);
    run(choice, 0.5, 128);
    for (std::uint32_t pass = 128; pass < 130; ++pass) {
        PassCounters counters = unmeasured();
        for (int i = 0; i < 100; ++i) counters.variance.add(steps_of(i % 2 == 0 ? 1.0 : 3.0), 0);
        choice.finish_pass(pass, counters, kTable);
    }
    CHECK(choice.variance_ratio() == Approx(1.0));
    CHECK(choice.ratio_factor() == Approx(std::exp(1.96 * 0.05 * std::sqrt(2.0))));
}

TEST_CASE("Guiding choice: without a measurable variance the belief stays") {
    for (const double guided : {0.0, -1.0}) {
        GuidingChoice choice = beginning(kLarge);
        run(choice, guided, 2);
        CHECK(choice.pays());
        CHECK_FALSE(choice.variance_ratio());
    }
    GuidingChoice dark = beginning(kLarge);
    for (std::uint32_t pass = 0; pass < 2; ++pass) dark.finish_pass(pass, unmeasured(), kTable);
    CHECK(dark.pays());
    CHECK_FALSE(dark.variance_ratio());
}

TEST_CASE("Guiding choice: a film that was interrupted before it decided leaves no belief") {
    GuidingChoice choice = beginning(kSmall);
    run(choice, 1.0, 3);
    GuidingChoice next = choice.restarted();
    next.begin_film(kSmall, false);
    CHECK(next.schedule().warm_up == 4);
    CHECK(next.pays());
}

TEST_CASE("Guiding choice: every value of its state is visited") {
    GuidingChoice choice = beginning(kSmall);
    run(choice, 0.5, 3, 0, 10);
    GuidingChoice copy;
    std::vector<double> values;
    const auto as_number = [](const auto& value) {
        if constexpr (requires { value.has_value(); })
            return value ? static_cast<double>(*value) : -1.0;
        else
            return static_cast<double>(value);
    };
    GuidingChoice::each_value(choice, [&](const auto& value) { values.push_back(as_number(value)); });
    CHECK(values.size() == 16);
    std::size_t next = 0;
    GuidingChoice::each_value(copy, [&](auto& value) {
        const double from = values[next++];
        if constexpr (requires { value.has_value(); }) {
            if (from >= 0.0) value = static_cast<typename std::remove_cvref_t<decltype(value)>::value_type>(from);
        } else {
            value = static_cast<std::remove_cvref_t<decltype(value)>>(from);
        }
    });
    for (GuidingChoice* one : {&choice, &copy}) run(*one, 0.7, 1, 3);
    CHECK(copy.variance_ratio() == choice.variance_ratio());
    CHECK(copy.variance_ratio());
    CHECK(copy.pays() == choice.pays());
}
