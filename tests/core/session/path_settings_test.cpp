#include "core/session/path_settings.h"

#include "tests/support/catch.hpp"

using namespace pl;

TEST_CASE("Path settings: guided paths play roulette late, others at every loss") {
    RenderSettings settings{.max_depth = 7, .next_event = false};
    const PathSettings plain = path_settings(settings, MethodId::Default);
    CHECK(plain.max_depth == 7);
    CHECK(plain.next_event == 0u);
    CHECK(plain.roulette_threshold == 1.0f);
    const PathSettings guided = path_settings(settings, MethodId::Reinforcement);
    CHECK(guided.roulette_threshold < 1.0f);
    settings.roulette = RouletteRule::Albedo;
    CHECK(path_settings(settings, MethodId::Reinforcement).roulette == RouletteRule::Albedo);
}

TEST_CASE("Path settings: without roulette paths end by their depth alone") {
    for (const bool next_event : {false, true})
        for (const int depth : {1, 7, 65536})
            for (const MethodId method : {MethodId::Default, MethodId::Precomputed, MethodId::Reinforcement}) {
                const PathSettings path =
                    path_settings({.max_depth = depth, .next_event = next_event, .roulette = kNoRoulette}, method);
                CHECK(path.roulette_start > path.max_depth);
                CHECK(path.roulette == RouletteRule::Albedo);
            }
    CHECK(probe_settings({.roulette = kNoRoulette}, MethodId::Precomputed).roulette_start == 65);
    CHECK(path_settings({}, MethodId::Default).roulette_start == PathSettings{}.roulette_start);
}

TEST_CASE("Path settings: only passes of methods that learn while they render have weights that grow") {
    CHECK(weight_ramp({}, MethodId::Default) == 1u);
    CHECK(weight_ramp({}, MethodId::Precomputed) == 1u);
    CHECK(weight_ramp({.next_event = true}, MethodId::Reinforcement) == 4u);
    CHECK(weight_ramp({.next_event = false}, MethodId::Reinforcement) == 8u);
}

TEST_CASE("Path settings: guided paths play roulette earlier with light samples") {
    RenderSettings settings{.next_event = false};
    const float without = path_settings(settings, MethodId::Reinforcement).roulette_threshold;
    settings.next_event = true;
    CHECK(path_settings(settings, MethodId::Reinforcement).roulette_threshold > without);
    CHECK(path_settings(settings, MethodId::Default).roulette_threshold == 1.0f);
}

TEST_CASE("Path settings: probes have random numbers of their own and the roulette of unguided paths") {
    const PathSettings probes = probe_settings({}, MethodId::Precomputed);
    CHECK(probes.stream == Stream::Precompute);
    CHECK(path_settings({}, MethodId::Precomputed).stream != Stream::Precompute);
    CHECK(probes.roulette_threshold == 1.0f);
}

TEST_CASE("Path settings: only methods that learn while they render learn the BSDF fraction") {
    RenderSettings settings;
    REQUIRE(settings.mixture.learned != 0);
    CHECK(mixture_of(settings, MethodId::Reinforcement).learned != 0);
    CHECK(mixture_of(settings, MethodId::Precomputed).learned == 0);
}
