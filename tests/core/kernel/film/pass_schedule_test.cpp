// The passes of a film by their numbers alone.
#include "core/kernel/film/pass_schedule.h"

#include <set>

#include "tests/support/catch.hpp"

using namespace pl;

TEST_CASE("Pass schedule: weights without a choice grow with the passes that have trained the field, to the end of "
          "their ramp") {
    for (const std::uint32_t pass : {0u, 1u, 100u, 0xffffffffu}) CHECK(PassSchedule{}.weight_of(pass) == 1u);
    const PassSchedule ramp{.ramp = 4};
    for (const std::uint32_t pass : {0u, 1u, 2u, 3u}) CHECK(ramp.weight_of(pass) == pass + 1);
    for (const std::uint32_t pass : {4u, 5u, 0xffffffffu}) CHECK(ramp.weight_of(pass) == 4u);
    const PassSchedule warm{.trained = 2, .ramp = 4};
    CHECK(warm.weight_of(0) == 3u);
    CHECK(warm.weight_of(1) == 4u);
    CHECK(PassSchedule{.trained = 0xffffffffu, .ramp = 8}.weight_of(0xffffffffu) == 8u);
}

TEST_CASE("Pass schedule: samples of a warm-up are numbered so that training has a half of the film of its own") {
    for (const std::uint32_t each : {1u, 2u}) {
        const PassSchedule schedule{
            .first_sample = PassSchedule::kTrainingSamples, .each = each, .warm_up = 2 * each};
        std::set<std::uint32_t> numbers;
        for (std::uint32_t pass = 0; pass < 100; ++pass) {
            const std::uint32_t sample = schedule.sample_of(pass);
            CHECK(numbers.insert(sample).second);
            if (pass < 2 * each) CHECK((sample % 2 == 1) == (pass < each));
            CHECK((sample < PassSchedule::kTrainingSamples) == (pass < each));
            if (pass >= 2 * each) CHECK(sample == PassSchedule::kTrainingSamples + pass);
        }
    }
    CHECK(PassSchedule{.first_sample = 5, .each = 1}.sample_of(0) == 5);
}

TEST_CASE("Pass schedule: questions come four times as late each, the first one early without a warm-up") {
    for (const std::uint32_t each : {1u, 2u})
        for (const bool warms_up : {true, false}) {
            const PassSchedule schedule{.each = each, .warm_up = warms_up ? 2 * each : 0};
            const std::set<std::uint32_t> starts{warms_up ? 64u : 8u, 64u, 256u, 1024u, 4096u};
            std::uint32_t since = 2 * each;
            for (std::uint32_t pass = schedule.warm_up; pass < 5000; ++pass) {
                since = starts.contains(pass) ? 0 : std::min(since + 1, 2 * each);
                REQUIRE(schedule.since_question(pass) == since);
                REQUIRE(schedule.weight_of(pass) == (since < each ? 1u : 8u));
            }
            CHECK(schedule.since_question(0x40000000u) == 0);
            CHECK(schedule.since_question(0xffffffffu) == 2 * each);
        }
}
