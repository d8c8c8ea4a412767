// The small functions that replace the library's, against double.
#include "core/kernel/base/math.h"

#include "core/kernel/base/frame.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"

using namespace pl;

namespace {

/// Largest difference over a million points of [low, high] and both ends.
template <class Fn, class Reference>
double largest_error(float low, float high, Fn&& fn, Reference&& reference) {
    constexpr int kPoints = 1000000;
    double largest = 0.0;
    for (int i = 0; i <= kPoints; ++i) {
        const float x = i < kPoints ? low + (high - low) * (static_cast<float>(i) / kPoints) : high;
        const double error = std::fabs(static_cast<double>(fn(x)) - reference(static_cast<double>(x)));
        largest = error <= largest ? largest : error;  // NaN counts as largest
    }
    return largest;
}

struct FrameErrors {
    double sum_of_squares = 0.0;
    double largest = 0.0;
    std::uint64_t count = 0;

    /// Deviation of the nine scalar products from the unit matrix.
    void add(Vec3f normal) {
        const Frame frame = make_frame(normal);
        const Vec3d axes[3] = {Vec3d{frame.x}, Vec3d{frame.y}, Vec3d{frame.z}};
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                const double deviation = glm::dot(axes[i], axes[j]) - (i == j ? 1.0 : 0.0);
                sum_of_squares += deviation * deviation;
                largest = std::fabs(deviation) <= largest ? largest : std::fabs(deviation);
            }
        count += 9;
    }
    double root_mean_square() const { return std::sqrt(sum_of_squares / static_cast<double>(count)); }
};

/// Unit to rounding, at a small angle from the pole.
Vec3f near_pole(test::Uniforms& random, float pole) {
    const double sine = std::exp2(-40.0 * static_cast<double>(random.next()));
    const double angle = 6.283185307179586 * static_cast<double>(random.next());
    return Vec3f{Vec3d{sine * std::cos(angle), sine * std::sin(angle),
                       static_cast<double>(pole) * std::sqrt(1.0 - sine * sine)}};
}

}  // namespace

TEST_CASE("Sine and cosine and arctangent keep the error they state") {
    // By lambdas: functions that are always inlined have no address.
    const auto sine = [](float x) { return sin_quarter<One>(x); };
    const auto cosine = [](float x) { return cos_quarter<One>(x); };
    const auto atan = [](float x) { return atan_unit<One>(x); };
    const auto to_sin = [](double x) { return std::sin(x); };
    const auto to_cos = [](double x) { return std::cos(x); };
    const auto to_atan = [](double x) { return std::atan(x); };
    CHECK(largest_error(-kPiOver4, kPiOver4, sine, to_sin) < 1e-7);
    CHECK(largest_error(-kPiOver4, kPiOver4, cosine, to_cos) < 1e-7);
    CHECK(largest_error(-1.0f, 1.0f, atan, to_atan) < 2e-7);
    CHECK(largest_error(-1e-20f, 1e-20f, atan, to_atan) < 1e-27);
    CHECK(largest_error(-1e-20f, 1e-20f, sine, to_sin) < 1e-27);
}

TEST_CASE("Sine and arctangent are odd and cosine is even bit by bit") {
    test::Uniforms random(1);
    for (int i = 0; i < 100000; ++i) {
        const float x = kPiOver4 * random.next();
        if (sin_quarter<One>(-x) != -sin_quarter<One>(x) || cos_quarter<One>(-x) != cos_quarter<One>(x) ||
            atan_unit<One>(-x) != -atan_unit<One>(x))
            FAIL("at " << x);
    }
    SUCCEED();
}

TEST_CASE("Neighbouring floats") {
    CHECK(next_float_up(0.0f) == std::numeric_limits<float>::denorm_min());
    CHECK(next_float_up(-0.0f) == std::numeric_limits<float>::denorm_min());
    CHECK(next_float_down(0.0f) == -std::numeric_limits<float>::denorm_min());
    CHECK(next_float_up(kInfinity) == kInfinity);
    CHECK(next_float_down(-kInfinity) == -kInfinity);
    CHECK(next_float_up(std::numeric_limits<float>::max()) == kInfinity);
    for (const float same : {0.0f, -0.0f, 1.5f, -1.5f, kInfinity, -kInfinity})
        CHECK(std::bit_cast<std::uint32_t>(step_float(same, 0)) == std::bit_cast<std::uint32_t>(same));
    for (const std::int32_t step : {-1, 0, 1})
        for (const std::uint32_t nan : {0x7f800001u, 0x7fffffffu, 0xff800001u, 0xffffffffu})
            CHECK(std::isnan(step_float(std::bit_cast<float>(nan), step)));
    test::Uniforms random(2);
    for (int i = 0; i < 100000; ++i) {
        const float x = std::bit_cast<float>(random.bits());
        if (!(std::fabs(x) < kInfinity)) continue;
        if (next_float_up(x) != std::nextafter(x, kInfinity) || next_float_down(x) != std::nextafter(x, -kInfinity))
            FAIL("at " << x);
    }
}

TEST_CASE("Validity of radiance and small helpers at the edges of float") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(is_valid_radiance({0.0f, -0.0f, 3e38f}));
    CHECK_FALSE(is_valid_radiance({nan, 0.0f, 0.0f}));
    CHECK_FALSE(is_valid_radiance({0.0f, nan, 0.0f}));
    CHECK_FALSE(is_valid_radiance({0.0f, 0.0f, nan}));
    CHECK_FALSE(is_valid_radiance({0.0f, kInfinity, 0.0f}));
    CHECK_FALSE(is_valid_radiance({0.0f, 0.0f, -1e-45f}));
    CHECK(safe_sqrt(-1e-9f) == 0.0f);
    CHECK(safe_sqrt(4.0f) == 2.0f);
    CHECK(clamp_to(2.0f, 0.0f, 1.0f) == 1.0f);
    CHECK(clamp_to(-2.0f, 0.0f, 1.0f) == 0.0f);
}

TEST_CASE("Logarithm and exponential are as exact as they promise") {
    CHECK(log_of(1.0f) == 0.0f);
    CHECK(exp_of(0.0f) == 1.0f);
    for (float x = 1.2e-38f; x < 1e38f; x *= 1.0037f) {
        const double exact = std::log(static_cast<double>(x));
        REQUIRE(std::fabs(static_cast<double>(log_of(x)) - exact) <= 2e-7 * (1.0 + std::fabs(exact)));
    }
    for (float x = 87.0f; x >= -87.0f; x -= 0.0011f) {
        const double exact = std::exp(static_cast<double>(x));
        REQUIRE(std::fabs(static_cast<double>(exp_of(x)) / exact - 1.0) <= 1e-6);
    }
}

TEST_CASE("Decays and their complements keep all digits of small numbers") {
    const auto error = [](float got, double exact) { return std::fabs(static_cast<double>(got) / exact - 1.0); };
    CHECK(decay_of(0.0f) == 1.0f);
    CHECK(decay_of(kMostDecay) == 0.0f);
    CHECK(decay_of(kInfinity) == 0.0f);
    CHECK(complement_of_decay(0.0f) == 0.0f);
    CHECK(complement_of_decay(kInfinity) == 1.0f);
    CHECK(log_of_complement(0.0f) == 0.0f);
    for (float x = 1.0e-30f; x < kMostDecay; x *= 1.003f) {
        REQUIRE(error(decay_of(x), std::exp(-static_cast<double>(x))) <= 1e-6);
        REQUIRE(error(complement_of_decay(x), -std::expm1(-static_cast<double>(x))) <= 1e-6);
    }
    for (float y = 1.0e-30f; y < 1.0f; y *= 1.003f)
        REQUIRE(error(log_of_complement(y), -std::log1p(-static_cast<double>(y))) <= 1e-6);
    CHECK(error(log_of_complement(0x1.fffffep-1f), 24.0 * std::log(2.0)) <= 1e-6);
}

// Rounding alone gives about 1e-7; the classic formula reaches 0.3 next to the lower pole.
TEST_CASE("Frames are orthonormal everywhere and next to the poles") {
    test::Uniforms random(3);
    FrameErrors everywhere, upper, lower;
    for (int i = 0; i < 1000000; ++i) {
        everywhere.add(Vec3f{glm::normalize(Vec3d{random.direction()})});
        upper.add(near_pole(random, 1.0f));
        lower.add(near_pole(random, -1.0f));
    }
    for (const FrameErrors& errors : {everywhere, upper, lower}) {
        CHECK(errors.root_mean_square() <= 3e-7);
        CHECK(errors.largest <= 2e-6);
    }
    FrameErrors axes;
    for (const float sign : {1.0f, -1.0f})
        for (int axis = 0; axis < 3; ++axis) {
            Vec3f normal{0.0f};
            normal[axis] = sign;
            axes.add(normal);
        }
    CHECK(axes.largest == 0.0);
}

TEST_CASE("A frame takes local z to its normal and back") {
    test::Uniforms random(4);
    for (int i = 0; i < 1000; ++i) {
        const Vec3f normal = random.direction();
        const Frame frame = make_frame(normal);
        const Vec3f local = random.direction();
        // Three products and sums of numbers below 1, twice: 12 roundoffs.
        REQUIRE(glm::length(frame.to_local(frame.to_world(local)) - local) < 3e-6f);
        REQUIRE(frame.to_world({0.0f, 0.0f, 1.0f}) == normal);
    }
}

TEST_CASE("The root mean square of channels is exact for gray and for one channel, else within 13 %") {
    CHECK(rms(Vec3f{0.0f}) == 0.0f);
    for (const float size : {1e-38f, 0.25f, 1.0f, 8.0f, 1e37f}) {
        INFO(size);
        CHECK(rms(Vec3f{size}) == Approx(size).epsilon(1e-6));
        for (const Vec3f& one : {Vec3f{size, 0, 0}, Vec3f{0, size, 0}, Vec3f{0, 0, size}})
            CHECK(rms(one) == Approx(size / std::sqrt(3.0)).epsilon(1e-6));
    }
    CHECK(rms(Vec3f{0.25f}) == 0.25f);
    constexpr int kSteps = 20;
    for (int red = 0; red <= kSteps; ++red)
        for (int green = 0; green <= kSteps; ++green)
            for (int blue = 0; blue <= kSteps; ++blue) {
                const Vec3f rgb = Vec3f{red, green, blue} * 0.05f;
                const Vec3d exact{rgb};
                const double expected = std::sqrt((exact.x * exact.x + exact.y * exact.y + exact.z * exact.z) / 3.0);
                CHECK(rms(rgb) <= expected * 1.127);
                CHECK(rms(rgb) >= expected * 0.965);
            }
}
