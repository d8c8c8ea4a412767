// Shares of variance of random parts whose variances and covariances are known.
// The noise of pixels whose light is known: a lamp over a floor, and the Cornell box.
#include "core/diagnose/pixel_noise.h"

#include <numeric>
#include <random>

#include "core/diagnose/record_path.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/rectangle_light.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::diagnose;
using namespace pl::test;

namespace {

double sum_of(std::span<const Interval> shares) {
    return std::accumulate(shares.begin(), shares.end(), 0.0,
                           [](double sum, const Interval& share) { return sum + share.value; });
}

/// A path of two independent parts with variances 3 and 1, and one that takes half of the first away again.
NoiseSums three_parts(std::uint32_t seed, int paths, double scale = 1.0) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    NoiseSums sums;
    for (int i = 0; i < paths; ++i) {
        const double a = std::sqrt(3.0) * normal(random);
        const double b = normal(random);
        const Contribution parts[] = {
            {.found_by = Technique::LightSampling, .bounces = 1, .light = scale * a},
            {.found_by = Technique::Bsdf, .bounces = 2, .light = scale * b},
            {.found_by = Technique::Bsdf, .bounces = 20, .is_distant = true, .light = scale * (5.0 - 0.5 * a)},
        };
        sums.add(static_cast<std::size_t>(i) % kJackknifeGroups, parts);
    }
    return sums;
}

const Interval& share_of(const NoiseShares& shares, Technique technique) {
    return shares.found_by[static_cast<std::size_t>(technique)];
}

}  // namespace

// T = a/2 + b + 5: Var T = 3/4 + 1 = 7/4. Cov(a, T) = 3/2, Cov(b, T) = 1, Cov(-a/2, T) = -3/4: shares 6/7, 4/7 and -3/7. 100 experiments
// of 3200 paths, seeds 1 to 100. Each 95 % interval misses in 5 of 100 on average; more than 15 has a probability below 1e-4, and
// intervals half as wide would miss in 33.
TEST_CASE("shares are covariances with the whole, and their intervals have the stated confidence") {
    std::array<int, 3> missed{};
    for (std::uint32_t seed = 1; seed <= 100; ++seed) {
        const PixelEstimate estimate = three_parts(seed, 3200).estimate();
        REQUIRE(estimate.shares);
        CHECK_THAT(sum_of(estimate.shares->found_by), WithinAbs(1.0, 1.0e-12));
        CHECK_THAT(sum_of(estimate.shares->bounces), WithinAbs(1.0, 1.0e-12));
        CHECK_THAT(sum_of(estimate.shares->lights), WithinAbs(1.0, 1.0e-12));
        missed[0] += share_of(*estimate.shares, Technique::LightSampling).contains(6.0 / 7.0) ? 0 : 1;
        missed[1] += share_of(*estimate.shares, Technique::Bsdf).contains(1.0 / 7.0) ? 0 : 1;
        missed[2] += estimate.shares->bounces[kBounceClasses - 1].contains(-3.0 / 7.0) ? 0 : 1;
        CHECK(estimate.shares->bounces[kBounceClasses - 1].value == estimate.shares->lights[1].value);
        CHECK(share_of(*estimate.shares, Technique::Field).value == 0.0);
    }
    for (const int count : missed) CHECK(count <= 15);
}

// Var T = 7/4, mean 5: 64000 paths have standard errors of 0.0098 and 0.0052; the tolerances are five of them.
TEST_CASE("mean and variance of a path") {
    const PixelEstimate estimate = three_parts(7, 64000).estimate();
    CHECK(estimate.paths == 64000);
    CHECK_THAT(estimate.variance.value, WithinAbs(1.75, 0.049));
    CHECK_THAT(estimate.mean.value, WithinAbs(5.0, 0.026));
    CHECK(estimate.variance.low < estimate.variance.value);
}

// Twice the spread at a third of the cost: 4 / 3 to the disadvantage. Variances of 6400 paths each have relative errors of 1.8 %; times
// are exact here.
TEST_CASE("the gain is the ratio of variances times seconds") {
    NoiseSums base = three_parts(11, 6400);
    NoiseSums method = three_parts(12, 6400, 2.0);
    for (std::size_t group = 0; group < kJackknifeGroups; ++group) {
        base.add_seconds(group, 3.0);
        method.add_seconds(group, 1.0);
    }
    const std::optional<Gain> gain = pixel_gain(base, method);
    REQUIRE(gain);
    CHECK_THAT(gain->samples.value, WithinRel(0.25, 0.13));
    CHECK_THAT(gain->cost.value, WithinRel(3.0, 1.0e-9));
    CHECK_THAT(gain->net.value, WithinRel(0.75, 0.13));
    CHECK(verdict_of(gain->net) == pl::Verdict::Slower);
    CHECK(verdict_of(pixel_gain(base, base)->net) == pl::Verdict::NoDifference);
}

TEST_CASE("without variance there are neither shares nor a gain") {
    NoiseSums still;
    const Contribution lamp[] = {{.found_by = Technique::Camera, .light = 2.0}};
    CHECK_FALSE(still.has_all_groups());
    for (std::size_t group = 0; group < kJackknifeGroups; ++group) still.add(group, lamp);
    still.add(0, lamp);
    CHECK(still.has_all_groups());
    const PixelEstimate estimate = still.estimate();
    CHECK(estimate.mean.value == 2.0);
    CHECK(estimate.variance.value == 0.0);
    CHECK_FALSE(estimate.shares);
    CHECK_FALSE(pixel_gain(still, three_parts(1, 320)));
}

namespace {

constexpr std::uint32_t kNoisyPixel = 20 * 61 + 30;

PixelNoise noise_of(const Session& session, std::uint32_t pixel, std::uint32_t paths) {
    PixelNoiseTracer tracer(pass_pair(session, slot_of(session)), pixel);
    while (tracer.paths() < paths) REQUIRE(tracer.advance());
    return tracer.noise();
}

Session lit_floor(const SceneDescription& scene, bool next_event) {
    Session session = make_session(scene, small_settings(scene, {MethodId::Default, next_event}, 16, 16));
    render_passes(session, 1);
    return session;
}

double share(const PixelEstimate& estimate, Technique technique) {
    return estimate.shares->found_by[static_cast<std::size_t>(technique)].value;
}

}  // namespace

// A direction by the BSDF meets the lamp, of radiance 1, with the probability F of its form factor, and else nothing: the path brings
// albedo or 0. So the mean is albedo F and the variance albedo^2 F (1 - F). 65536 paths, seed 1: 99.9 % intervals of both are about one and a half
// times the 95 % ones; the half width of the variance's is below 2 %, so that a wrong share of roulette or a lost factor would be seen.
TEST_CASE("the variance of a floor under a lamp, by BSDF sampling, is that of a coin") {
    const LampOverFloor lamp = lamp_above(0.1f, 0.05f);
    const Session session = lit_floor(lamp.scene, false);
    const PixelEstimate estimate = noise_of(session, 8 * 16 + 8, 65536).plain;
    const double albedo = static_cast<double>(rectangle_detail::kAlbedo);
    const double factor = lamp.floor_radiance / albedo;
    CAPTURE(factor, estimate.mean.value, estimate.variance.value, estimate.variance.low, estimate.variance.high);
    const double expected = albedo * albedo * factor * (1.0 - factor);
    CHECK(estimate.variance.high - estimate.variance.low < 0.04 * expected);
    CHECK_THAT(estimate.variance.value, WithinAbs(expected, estimate.variance.high - estimate.variance.low));
    CHECK_THAT(estimate.mean.value, WithinAbs(lamp.floor_radiance, estimate.mean.high - estimate.mean.low));
    CHECK_THAT(share(estimate, Technique::Bsdf), WithinAbs(1.0, 1.0e-12));
    CHECK_THAT(estimate.shares->bounces[1].value, WithinAbs(1.0, 1.0e-12));
    CHECK_THAT(estimate.shares->lights[0].value, WithinAbs(1.0, 1.0e-12));
}

// With light samples, both techniques are independent of each other given the floor's point, so that their shares are their own variances
// over the sum. The variances are estimated here from other paths, of the picture's passes. 16384 paths each, seed 1.
TEST_CASE("with light samples the noise of a floor under a lamp is that of both techniques, each by itself") {
    const LampOverFloor lamp = lamp_above(0.1f, 0.05f);
    const Session session = lit_floor(lamp.scene, true);
    const PixelEstimate estimate = noise_of(session, 8 * 16 + 8, 16384).plain;
    PassPair passes = pass_pair(session, slot_of(session));
    Moments light;
    Moments scattered;
    for (std::uint32_t pass = 0; pass < 16384; ++pass) {
        double parts[2] = {0.0, 0.0};
        for (const Contribution& part : contributions_of(record_path(passes.plain, {}, 8 * 16 + 8, pass)))
            parts[part.found_by == Technique::LightSampling ? 0 : 1] += part.light;
        light.add(parts[0]);
        scattered.add(parts[1]);
    }
    const double expected = light.variance() / (light.variance() + scattered.variance());
    const Interval& got = estimate.shares->found_by[static_cast<std::size_t>(Technique::LightSampling)];
    CAPTURE(expected, got.value, got.low, got.high);
    CHECK(got.high - got.low < 0.1);
    CHECK_THAT(got.value, WithinAbs(expected, 2.0 * (got.high - got.low)));
    CHECK_THAT(share(estimate, Technique::Bsdf), WithinAbs(1.0 - got.value, 1.0e-12));
    CHECK_THAT(estimate.shares->bounces[1].value, WithinAbs(1.0, 1.0e-12));
}

TEST_CASE("contributions are all of a path's light") {
    const SceneDescription scene = shipped_scene("door");
    Session session = make_session(scene, small_settings(scene, {MethodId::Reinforcement, true}));
    render_passes(session, 4);
    PassReplay passes = session.pass_replay(slot_of(session));
    const AnyFieldView field = field_of(passes);
    std::array<int, kTechniqueCount> found{};
    for (std::uint32_t pixel = 0; pixel < 61 * 47; pixel += 7) {
        const PathRecord path = record_path(passes, field, pixel, 4);
        double sum = 0.0;
        for (const Contribution& part : contributions_of(path)) {
            sum += part.light;
            ++found[static_cast<std::size_t>(part.found_by)];
            CHECK((part.found_by == Technique::Camera) == (part.bounces == 0));
        }
        CHECK_THAT(sum, WithinAbs(static_cast<double>(path_light(path)), 1.0e-5 * (1.0 + sum)));
    }
    CHECK(found[static_cast<std::size_t>(Technique::LightSampling)] > 0);
    CHECK(found[static_cast<std::size_t>(Technique::Field)] > 0);
}

TEST_CASE("guidance has estimates of its own, with every path guided, and the same figures again") {
    const SceneDescription scene = shipped_scene("door");
    Session session = make_session(scene, small_settings(scene, {MethodId::Reinforcement, false}));
    render_passes(session, 24);
    const PixelNoise noise = noise_of(session, kNoisyPixel, 4096);
    REQUIRE(noise.guided);
    CHECK(noise.guided_method == MethodId::Reinforcement);
    CHECK(noise.plain.paths == 4096);
    CHECK(noise.guided->paths == 4096);
    CHECK(share(noise.plain, Technique::Field) == 0.0);
    CHECK(share(*noise.guided, Technique::Field) > 0.5);
    CHECK(noise.plain.seconds_per_path > 0.0);
    REQUIRE(noise.gain);
    CHECK_THAT(noise.gain->net.value, WithinRel(noise.gain->samples.value * noise.gain->cost.value, 1.0e-9));
    const PixelNoise again = noise_of(session, kNoisyPixel, 4096);
    CHECK(again.guided->variance.value == noise.guided->variance.value);
    CHECK(again.plain.mean.value == noise.plain.mean.value);
    CHECK(again.gain->samples.low == noise.gain->samples.low);
    // Both estimate the same pixel: their means agree within their intervals, each widened to 99.99 % by two.
    const double difference = std::abs(noise.plain.mean.value - noise.guided->mean.value);
    CHECK(difference <
          noise.plain.mean.high - noise.plain.mean.low + noise.guided->mean.high - noise.guided->mean.low);
}

TEST_CASE("the noise needs a path in every group, and a stop ends it") {
    const SceneDescription scene = shipped_scene("cornell");
    Session session = make_session(scene, small_settings(scene, {MethodId::Default, false}));
    render_passes(session, 1);
    PixelNoiseTracer tracer(pass_pair(session, slot_of(session)), kNoisyPixel);
    StopFlag stop{true};
    CHECK_FALSE(tracer.advance(&stop));
    CHECK(tracer.paths() == 0);
    for (std::size_t i = 1; i < kJackknifeGroups; ++i) tracer.advance();
    CHECK_FALSE(tracer.has_all_groups());
    tracer.advance();
    CHECK(tracer.has_all_groups());
    CHECK_FALSE(tracer.noise().guided);
    CHECK_FALSE(tracer.noise().gain);
}
