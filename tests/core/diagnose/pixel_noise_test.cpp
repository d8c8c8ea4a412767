// The noise of pixels whose light is known: a lamp over a floor, and the Cornell box.
#include "core/diagnose/pixel_noise.h"

#include <numeric>

#include "core/diagnose/record_path.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/rectangle_light.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::diagnose;
using namespace pl::test;

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

double share(const PixelEstimate& estimate, FoundBy technique) {
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
    CHECK_THAT(share(estimate, FoundBy::Bsdf), WithinAbs(1.0, 1.0e-12));
    CHECK_THAT(estimate.shares->bounces[1].value, WithinAbs(1.0, 1.0e-12));
    CHECK_THAT(estimate.shares->lights[0].value, WithinAbs(1.0, 1.0e-12));
}

// With light samples, both techniques are independent of each other given the floor's point, so that their shares are their own variances
// over the sum. Those are estimated from other paths here, those of the picture's passes. 16384 paths each, seed 1.
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
            parts[part.found_by == FoundBy::LightSampling ? 0 : 1] += part.light;
        light.add(parts[0]);
        scattered.add(parts[1]);
    }
    const double expected = light.variance() / (light.variance() + scattered.variance());
    const Interval& got = estimate.shares->found_by[static_cast<std::size_t>(FoundBy::LightSampling)];
    CAPTURE(expected, got.value, got.low, got.high);
    CHECK(got.high - got.low < 0.1);
    CHECK_THAT(got.value, WithinAbs(expected, 2.0 * (got.high - got.low)));
    CHECK_THAT(share(estimate, FoundBy::Bsdf), WithinAbs(1.0 - got.value, 1.0e-12));
    CHECK_THAT(estimate.shares->bounces[1].value, WithinAbs(1.0, 1.0e-12));
}

TEST_CASE("contributions are all of a path's light") {
    const SceneDescription scene = shipped_scene("door");
    Session session = make_session(scene, small_settings(scene, {MethodId::Reinforcement, true}));
    render_passes(session, 4);
    PassReplay passes = session.pass_replay(slot_of(session));
    const AnyFieldView field = field_of(passes);
    std::array<int, kFoundByCount> found{};
    for (std::uint32_t pixel = 0; pixel < 61 * 47; pixel += 7) {
        const PathRecord path = record_path(passes, field, pixel, 4);
        double sum = 0.0;
        for (const Contribution& part : contributions_of(path)) {
            sum += part.light;
            ++found[static_cast<std::size_t>(part.found_by)];
            CHECK((part.found_by == FoundBy::Camera) == (part.bounces == 0));
        }
        CHECK_THAT(sum, WithinAbs(static_cast<double>(path_light(path)), 1.0e-5 * (1.0 + sum)));
    }
    CHECK(found[static_cast<std::size_t>(FoundBy::LightSampling)] > 0);
    CHECK(found[static_cast<std::size_t>(FoundBy::Field)] > 0);
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
    CHECK(share(noise.plain, FoundBy::Field) == 0.0);
    CHECK(share(*noise.guided, FoundBy::Field) > 0.5);
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
