#include "core/session/path_settings.h"

#include "tests/support/catch.hpp"

using namespace pl;

TEST_CASE("Path settings: guided paths play roulette late and split, others play at every loss") {
    RenderSettings settings;
    settings.max_depth = 7;
    settings.next_event = true;
    const PathSettings plain = path_settings(settings, MethodId::Default);
    CHECK(plain.max_depth == 7);
    CHECK(plain.next_event == 1u);
    CHECK(plain.roulette_threshold == 1.0f);
    CHECK(plain.split_threshold == kInfinity);
    const PathSettings guided = path_settings(settings, MethodId::Reinforcement);
    CHECK(guided.roulette_threshold < 1.0f);
    CHECK(guided.split_threshold == 2.0f);
    settings.roulette = RouletteRule::Albedo;
    CHECK(path_settings(settings, MethodId::Reinforcement).split_threshold == kInfinity);
    settings.roulette = RouletteRule::Field;
    CHECK(path_settings(settings, MethodId::Reinforcement).roulette_threshold < 1.0f);
}

TEST_CASE("Path settings: guided paths play roulette earlier with light samples") {
    RenderSettings settings;
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
