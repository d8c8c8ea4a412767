// Scenes in which radiance is the same everywhere: they show wrong weights, lost light and wrong counts, whatever the
// directions. First without any sampling error, path by path; then every pixel and every cell of every table.
#include "tests/support/catch.hpp"
#include "tests/support/scenes/closed_scenes.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/film_samples.h"
#include "tests/support/session/sessions.h"

using namespace pl;
using namespace pl::test;

namespace {

/// No roulette within the paths of these tests.
constexpr std::uint32_t kNever = 1000;

/// Rounding of a product of k+1 factors, each of which costs four operations.
float rounding(std::uint32_t vertices) { return 4.0f * static_cast<float>(vertices + 1) * kRoundoff; }

/// Pixels that are off in any channel. Directions exactly along the horizon end a path early; they are counted.
std::uint64_t count_wrong(const FilmSamples& samples, Vec3f expected, Vec3f tolerance) {
    std::uint64_t wrong = 0;
    for (const Vec3f& value : samples.values) {
        const Vec3f off = absolute(value - expected);
        wrong += off.x <= tolerance.x && off.y <= tolerance.y && off.z <= tolerance.z ? 0 : 1;
    }
    return wrong;
}

}  // namespace

// R2: without roulette a path of the furnace that is cut after k vertices brings e (1 - rho^k) / (1 - rho), whatever
// its directions: no sampling error. 65536 paths each, and every one has to agree.
TEST_CASE("Furnace paths cut after k vertices bring the geometric sum exactly") {
    for (const float rho : {0.5f, 0.8f})
        for (const std::uint32_t depth : {1u, 2u, 3u, 10u, 64u}) {
            const SceneDescription scene = furnace_scene(0.25f, rho);
            const FilmSamples samples =
                sample_film(scene, {256, 256}, {.max_depth = depth, .roulette_start = kNever});
            const auto exact = static_cast<float>(0.25 * (1.0 - std::pow(static_cast<double>(rho), depth)) /
                                                  (1.0 - static_cast<double>(rho)));
            INFO("albedo " << rho << ", cut after " << depth);
            CHECK(count_wrong(samples, Vec3f{exact}, Vec3f{rounding(depth) * exact}) <=
                  samples.counters.path.zero_directions);
            CHECK(samples.counters.path.zero_directions <= 2);
            CHECK(samples.counters.path.truncated + samples.counters.path.zero_directions == samples.counters.paths);
            CHECK(samples.counters.path.escaped == 0);
        }
}

// R3: any closed scene in which everything emits 1 - albedo is filled with radiance 1, and a path brings 1 minus the
// product of the albedos it met. The cut after 64 vertices leaves at most 0.8^64.
TEST_CASE("Closed scenes in equilibrium show 1 in every pixel of every path") {
    SceneDescription door = in_equilibrium(shipped_scene("door"));
    SceneDescription cube = in_equilibrium(box_scene(
        {.albedo = {Vec3f{0.5f, 0.8f, 0.2f}, Vec3f{0.7f}, Vec3f{0.3f}, Vec3f{0.8f}, Vec3f{0.6f}, Vec3f{0.0f}}}));
    for (const SceneDescription& scene : {door, cube}) {
        const FilmSamples samples = sample_film(scene, {256, 256}, {.max_depth = 64, .roulette_start = kNever});
        const float tolerance = rounding(64) + std::pow(0.8f, 64.0f);
        INFO(scene.name);
        CHECK(count_wrong(samples, Vec3f{1.0f}, Vec3f{tolerance}) <= samples.counters.path.zero_directions);
        CHECK(samples.counters.path.zero_directions <= 2);
        CHECK(samples.counters.path.escaped == 0);
    }
}

// R22: a camera that looks at a surface that only emits sees its emission, bit for bit.
TEST_CASE("A black emitter shows its emission exactly") {
    BoxLook look;
    look.emission.fill(Vec3f{17.0f, 12.1f, 4.3f});
    const FilmSamples samples = sample_film(box_scene(look), {64, 64}, {});
    for (const Vec3f& value : samples.values) REQUIRE(value == (Vec3f{17.0f, 12.1f, 4.3f}));
}

// R19: with roulette from the first vertex on, the number of vertices is geometric: mean e/(1-rho) and variance
// e^2 rho/(1-rho)^2. Seed 1, 1e6 paths: the mean resolves 1 % (rho 0.5: 0.6 %), the variance 3 %, alpha 1e-6.
TEST_CASE("Roulette has the mean and the variance of a geometric walk") {
    for (const double rho : {0.5, 0.8}) {
        const FilmSamples samples = sample_film(furnace_scene(static_cast<float>(1.0 - rho), static_cast<float>(rho)),
                                                {1000, 1000}, {.seed = 1, .max_depth = 1000, .roulette_start = 1});
        Moments mean, variance;
        for (const Vec3f& value : samples.values) {
            const auto x = static_cast<double>(value.x);
            mean.add(x);
            variance.add((x - 1.0) * (x - 1.0));
        }
        INFO("albedo " << rho);
        CHECK(mean_equals(mean, {1.0}, 0.01));
        CHECK(mean_equals(variance, {rho}, 0.03));
    }
}

// The same as the program does it: roulette from the third vertex on, which plays for the albedos of the first two as
// well. Three vertices are certain; a fourth has probability rho^3, and each further one rho.
TEST_CASE("Roulette that starts late has the variance of its walk") {
    constexpr double kRho = 0.5;
    constexpr double kEmission = 0.5;
    constexpr double kStart = kRho * kRho * kRho;
    const FilmSamples samples =
        sample_film(furnace_scene(0.5f, 0.5f), {1000, 1000}, {.seed = 1, .roulette_start = 3});
    const double expected =
        kEmission * kEmission *
        (kStart * (1.0 + kRho) / ((1.0 - kRho) * (1.0 - kRho)) - kStart * kStart / ((1.0 - kRho) * (1.0 - kRho)));
    Moments mean, variance;
    for (const Vec3f& value : samples.values) {
        const auto x = static_cast<double>(value.x);
        mean.add(x);
        variance.add((x - 1.0) * (x - 1.0));
    }
    CHECK(mean_equals(mean, {1.0}, 0.005));
    CHECK(mean_equals(variance, {expected}, 0.05));
}

namespace {

/// Small tables: a furnace has nothing to learn but one number, and tables cost an update per pass.
FieldSettings small_field() {
    FieldSettings field;
    field.volumes = 24;
    field.bins = 16;
    return field;
}

/// Rule S1 in every pixel of the shipped furnace, and in the mean of all. Returns the worst decision.
Decision judge_furnace(Estimator estimator, int batches, std::uint32_t passes, double pixel_delta,
                       double mean_delta) {
    constexpr int kSide = 8;
    const SceneDescription scene = shipped_scene("furnace");
    RenderSettings settings = settings_for(scene, estimator, kSide, kSide);
    settings.field = small_field();
    Session session = make_session(scene, settings);
    Picture picture(kSide, kSide, 1);  // tiles of one pixel
    render_batches(session, picture, batches, passes);
    Decision worst = mean_equals(picture.channels[1].whole(), {1.0}, mean_delta);
    for (const Moments& pixel : picture.channels[1].tiles())
        worst = worse_of(worst, mean_equals(pixel, {1.0}, pixel_delta));
    return worst;
}

void judge_furnaces(std::uint32_t passes, double pixel_delta, double mean_delta) {
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        CHECK(judge_furnace(estimator, 64, passes, pixel_delta, mean_delta));
    }
}

}  // namespace

// Seed 1, 64 pixels of 64 x 48 samples, coefficient of variation 0.4: a pixel resolves 8 %, their mean 0.8 %.
TEST_CASE("Every method shows e/(1-rho) in every pixel of the furnace") { judge_furnaces(48, 0.08, 0.008); }
TEST_CASE("Every method shows e/(1-rho) within 4 % in every pixel of the furnace", "[merge]") {
    judge_furnaces(192, 0.04, 0.004);
}
TEST_CASE("Every method shows e/(1-rho) in every pixel of the furnace, finely", "[nightly]") {
    judge_furnaces(5400, 0.007, 0.0009);
}
