// Own sine, cosine and arctangent in turns against the library's in double.
#include "core/kernel/base/angles.h"

#include "tests/support/catch.hpp"
#include "tests/support/numbers.h"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;

TEST_CASE("Sine and cosine of turns") {
    test::Uniforms random(1);
    double largest = 0.0;
    for (int i = 0; i < 1000000; ++i) {
        const float turns = random.between(-1, 1);
        const SineCosine got = sine_cosine_of_turns(turns);
        const double angle = kTurn * static_cast<double>(turns);
        largest = std::max(largest, std::fabs(static_cast<double>(got.sine) - std::sin(angle)));
        largest = std::max(largest, std::fabs(static_cast<double>(got.cosine) - std::cos(angle)));
    }
    CHECK(largest < 2e-7);
    for (const float turns : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f, -0.25f, 1000.25f}) {
        const SineCosine got = sine_cosine_of_turns(turns);
        CHECK(std::fabs(got.sine) + std::fabs(got.cosine) == 1.0f);
    }
    CHECK(sine_cosine_of_turns(0.25f).sine == 1.0f);
    CHECK(sine_cosine_of_turns(-0.25f).sine == -1.0f);
    CHECK(sine_cosine_of_turns(0.5f).cosine == -1.0f);
    for (int i = 0; i <= 1000; ++i) {
        const float turns = 0.001f * static_cast<float>(i);
        CHECK(sine_cosine_of_positive_turns(turns).sine == sine_cosine_of_turns(turns).sine);
        CHECK(sine_cosine_of_positive_turns(turns).cosine == sine_cosine_of_turns(turns).cosine);
    }
}

TEST_CASE("Turns of a direction in all octants") {
    test::Uniforms random(2);
    double largest = 0.0;
    for (int i = 0; i < 1000000; ++i) {
        const float y = random.between(-1, 1) * std::exp2(random.between(-30, 30));
        const float x = random.between(-1, 1) * std::exp2(random.between(-30, 30));
        const double expected = std::atan2(static_cast<double>(y), static_cast<double>(x)) / kTurn;
        largest = std::max(largest, std::fabs(static_cast<double>(turns_of(y, x)) - expected));
    }
    CHECK(largest < 1e-7);
    CHECK(turns_of(0, 1) == 0.0f);
    CHECK(turns_of(1, 0) == 0.25f);
    CHECK(turns_of(-1, 0) == -0.25f);
    CHECK(turns_of(0, -1) == 0.5f);
    CHECK(turns_of(0, 0) == 0.0f);
}
