// The sentence above the plot.
#include <string>

#include "tests/support/catch.hpp"
#include "tests/ui/hand_made_runs.h"
#include "ui/plot/headlines.h"

using namespace pl;
using namespace pl::test;

TEST_CASE("Headline: factors and their product, with one run each") {
    const std::vector<Headline> lines = make_headlines(two_runs(), kThisPicture);
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].run == 2);
    CHECK_THAT(lines[0].text, contains("Reinforcement CPU needs 4.0x fewer samples than Default CPU, each costs 2.0x "
                                       "more: 2.0x faster to the same error (one run each: no interval)"));
}

TEST_CASE("Headline: runs of several seeds give an interval") {
    Runs runs;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const double luck = 1.0 + 0.02 * static_cast<double>(seed);
        const auto base = make_run({.number = 2 * seed, .error_of_sample = luck});
        const auto learned = make_run({.number = 2 * seed + 1,
                                       .method = MethodId::Reinforcement,
                                       .seconds_per_sample = 0.2,
                                       .error_of_sample = 0.25 / luck});
        base->label.seed = seed;
        learned->label.seed = seed;
        runs.push_back(base);
        runs.push_back(learned);
        const std::vector<Headline> lines = make_headlines(runs, kThisPicture);
        REQUIRE(lines.size() == 1);
        INFO(lines[0].text);
        CHECK_THAT(lines[0].text, contains(seed == 1  ? std::string("one run each: no interval")
                                           : seed < 5 ? "(only " + std::to_string(seed) + " runs: no interval)"
                                                      : std::string("(95 %: ")));
        CHECK((lines[0].text.find("seed") == std::string::npos));
    }
    // A run that has just begun does not shorten the others; a second one of the same seed replaces the first.
    const std::string before = make_headlines(runs, kThisPicture)[0].text;
    const auto begun = make_run({.number = 20, .method = MethodId::Reinforcement, .last_sample = 4});
    begun->label.seed = 6;
    runs.push_back(begun);
    CHECK(make_headlines(runs, kThisPicture)[0].text == before);
    // Runs with other settings are no repetitions.
    const auto other = make_run({.number = 21, .method = MethodId::Reinforcement});
    other->label.details = "400 volumes";
    runs.push_back(other);
    CHECK_THAT(make_headlines(runs, kThisPicture)[0].text, contains("(one run"));
}

TEST_CASE("Headline: as plain when learning loses, and without a reference") {
    const auto losing = make_run({.number = 2,
                                  .method = MethodId::Precomputed,
                                  .setup_seconds = 20.0,
                                  .seconds_per_sample = 0.4,
                                  .error_of_sample = 0.5,
                                  .with_reference = false});
    const std::vector<Headline> lines = make_headlines(Runs{make_run({}), losing}, kThisPicture);
    CHECK_THAT(lines[0].text, contains("slower to the same error"));
    CHECK_THAT(lines[0].text, contains("own noise: there is no reference"));
}

TEST_CASE("Headline: says what to do while there is nothing to compare") {
    CHECK_THAT(make_headlines({}, kThisPicture)[0].text, contains("Nothing measured yet"));
    CHECK_THAT(make_headlines(Runs{make_run({})}, kThisPicture + 1)[0].text, contains("Nothing measured yet"));
    CHECK_THAT(make_headlines(Runs{make_run({})}, kThisPicture)[0].text, contains("Only default so far: 2, 3 render"));
    const Runs alone{make_run({.method = MethodId::Reinforcement})};
    CHECK_THAT(make_headlines(alone, kThisPicture)[0].text, contains("nothing to be compared with yet"));
    // A run that has just begun is listed, but does not replace one that was measured.
    const auto begun = std::make_shared<LiveRun>(*make_run({.number = 3, .method = MethodId::Reinforcement}));
    begun->points.clear();
    CHECK_THAT(make_headlines(Runs{make_run({}), begun}, kThisPicture)[0].text, contains("too few samples"));
    Runs runs = two_runs();
    runs.push_back(begun);
    const std::vector<Headline> lines = make_headlines(runs, kThisPicture);
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].text == make_headlines(two_runs(), kThisPicture)[0].text);
    // A default run of another picture is no baseline.
    const Runs other{make_run({.picture = 8}), make_run({.number = 2, .method = MethodId::Reinforcement})};
    CHECK_THAT(make_headlines(other, kThisPicture)[0].text, contains("nothing to be compared with yet"));
}
