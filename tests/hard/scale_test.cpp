// Sizes and places: no length is special. Powers of two change no bit; other sizes, places and turns no mean.
#include <algorithm>

#include "core/scene/float_range.h"
#include "tests/hard/hard_scenes.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/cornell_variants.h"
#include "tests/support/session/film_samples.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

namespace {

State state_after(const SceneDescription& scene, Estimator estimator, std::uint32_t passes) {
    Session session = make_session(scene, small_settings(scene, estimator, 17, 13));
    render_passes(session, passes);
    return state_of(session);
}

void check_powers_of_two(const std::vector<int>& exponents, std::span<const Estimator> estimators) {
    for (const std::string& name : list_scenes(find_assets_dir())) {
        const SceneDescription scene = shipped_scene(name);
        for (const Estimator estimator : estimators) {
            const State expected = state_after(scene, estimator, 3);
            for (const int exponent : exponents) {
                INFO(name << " by 2^" << exponent << ", " << estimator);
                const State state = state_after(scaled(scene, std::ldexp(1.0f, exponent)), estimator, 3);
                CHECK(same_film(expected, state));
                CHECK(same_events(expected.snapshot.counters, state.snapshot.counters));
                CHECK(same_bits(expected.tables.radiance, state.tables.radiance));
                CHECK(same_bits(expected.tables.visits, state.tables.visits));
            }
        }
    }
}

}  // namespace

TEST_CASE("Every shipped scene has the same bits 1024 times as large and as small", "[hard]") {
    check_powers_of_two({-10, 10}, std::array{kEstimators[1], kEstimators[4]});
}
TEST_CASE("Every shipped scene has the same bits by every method from 2^-20 to 2^20", "[hard][merge]") {
    check_powers_of_two({-20, -10, 10, 20}, kEstimators);
}

namespace {

/// Rule S2: the scene as it is and its image under a motion that changes no light; 64 batches of so many passes each.
void check_same_light(const std::string& name, const SceneDescription& other, bool flip, Estimator estimator,
                      std::uint32_t passes, double delta) {
    constexpr int kSide = 32;
    constexpr int kBatches = 64;
    const auto render = [&](const SceneDescription& scene, bool flipped, std::uint64_t seed) {
        Session session = make_session(scene, quick_learner(scene, estimator, kSide, seed));
        Picture picture(kSide, kSide);
        std::vector<Vec3d> before(kSide * kSide, Vec3d{0.0});
        for (int batch = 0; batch < kBatches; ++batch) {
            render_passes(session, passes);
            const std::vector<Vec3d> after = film_sums(session);
            std::vector<Vec3d> batch_sums(after.size());
            for (std::size_t i = 0; i < after.size(); ++i) {
                const std::size_t x = i % kSide;
                batch_sums[flipped ? i - x + (kSide - 1 - x) : i] = after[i] - before[i];
            }
            picture.add(batch_sums, passes);
            before = after;
        }
        return picture;
    };
    INFO(name);
    CHECK(same_picture(render(shipped_scene(name), false, 1), render(other, flip, 2), delta));
}

void check_motions(const std::vector<std::string>& names, Estimator estimator, std::uint32_t passes, double delta) {
    for (const std::string& name : names) {
        const SceneDescription scene = shipped_scene(name);
        check_same_light(name, turned(scene), false, estimator, passes, delta);
        check_same_light(name, mirrored(scene), true, estimator, passes, delta);
    }
}

}  // namespace

// Seeds 1 and 2, 64 batches of 2 passes of 1024 paths; resolves 16 % of the whole.
TEST_CASE("Turned by a right angle and mirrored scenes have the same light", "[hard]") {
    check_motions({"ceiling", "sky", "open-box"}, {MethodId::Reinforcement, true}, 2, 0.16);
}
// The same with four times the samples.
TEST_CASE("Turned and mirrored scenes have the same light within 8 %", "[hard][merge]") {
    check_motions({"ceiling", "sky", "open-box"}, {MethodId::Reinforcement, true}, 8, 0.08);
}
// Mirrors, coats, facets, glass, a lens and the measured box. Seeds 1 and 2, 64 batches of 64 passes; resolves 8 %.
TEST_CASE("Turned and mirrored scenes of all surfaces have the same light within 8 %", "[hard][merge]") {
    check_motions({"cornell", "coats", "plates", "lens"}, {MethodId::Default, true}, 64, 0.08);
}

namespace {

/// Rule R3 path by path: radiance is 1 everywhere, so every path without roulette brings 1 less the product of albedos.
void check_equilibrium(const SceneDescription& scene, std::uint64_t allowed_escapes) {
    const FilmSamples samples =
        sample_film(in_equilibrium(scene), {128, 128}, {.max_depth = 64, .roulette_start = 1000});
    std::vector<double> off;
    for (const Vec3f& value : samples.values)
        off.push_back(static_cast<double>(max_component(absolute(value - Vec3f{1.0f}))));
    std::sort(off.begin(), off.end(), std::greater<>());
    const auto skipped = static_cast<std::size_t>(samples.counters.path.zero_directions + allowed_escapes);
    CHECK(samples.counters.path.zero_directions <= 2);
    CHECK(samples.counters.path.escaped <= allowed_escapes);
    CHECK(samples.counters.invalid_samples == 0);
    // 4 operations per vertex, and the cut after 64 of them.
    CHECK(within(off[skipped], 4.0 * 65.0 * 0x1p-24 + std::pow(0.8, 64.0)));
}

}  // namespace

TEST_CASE("Rooms from a micrometer to a thousand kilometers lose no ray and no light", "[hard]") {
    for (const float size : {1e-6f, 3e-4f, 0.07f, 7.0f, 3e3f, 1e6f}) {
        INFO("times " << size);
        check_equilibrium(scaled(shipped_scene("door"), size), 0);
        check_equilibrium(scaled(furnace_scene(0.5f, 0.5f), size), 0);
    }
}

namespace {

/// Sum of the differences of 4 x 4 tiles, relative to the sum of the tiles, of pictures by the same random numbers.
double tile_difference(const Snapshot& a, const Snapshot& b) {
    constexpr std::size_t kTiles = 4;
    std::array<Vec3d, kTiles * kTiles> sums{};
    std::array<Vec3d, kTiles * kTiles> differences{};
    const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(a.pixels.size())));
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const std::size_t tile = i / side * kTiles / side * kTiles + i % side * kTiles / side;
        sums[tile] += Vec3d{a.pixels[i]};
        differences[tile] += Vec3d{b.pixels[i]} - Vec3d{a.pixels[i]};
    }
    Vec3d sum{0.0};
    Vec3d difference{0.0};
    for (std::size_t tile = 0; tile < sums.size(); ++tile) {
        sum += sums[tile];
        difference += glm::abs(differences[tile]);
    }
    return (difference.x + difference.y + difference.z) / (sum.x + sum.y + sum.z);
}

/// As a file of that size is shown.
Snapshot picture_as_loaded(SceneDescription scene, Estimator estimator) {
    move_into_float_range(scene);
    return picture_of(scene, estimator, 24, 64);
}

/// What is learned differs by rounding, and then chooses other paths: those pictures differ by their noise.
double tolerance_of(Estimator estimator) { return estimator.method == MethodId::Default ? 0.002 : 0.15; }

void check_sizes(const SceneDescription& scene, std::span<const Estimator> estimators) {
    for (const Estimator estimator : estimators) {
        const Snapshot expected = picture_as_loaded(scene, estimator);
        for (int exponent = -9; exponent <= 8; ++exponent) {
            if (exponent == 0) continue;
            const float factor = static_cast<float>(std::pow(10.0, exponent));
            const Snapshot picture = picture_as_loaded(scaled(scene, factor), estimator);
            INFO(scene.name << " times 1e" << exponent << ", " << estimator);
            CHECK(within(tile_difference(expected, picture), tolerance_of(estimator)));
            CHECK(count_broken(picture) == 0);
        }
    }
}

}  // namespace

// Factors that are no powers of two round all lengths: few paths of 37 000 go another way.
TEST_CASE("Every size from 1e-9 to 1e8 of a scene shows the same picture", "[hard]") {
    const std::array estimators{kEstimators[1]};
    for (const SceneDescription& scene :
         {shipped_scene("cornell"), cornell_with_delta_lights(), cornell_with_stained_glass()})
        check_sizes(scene, estimators);
}
TEST_CASE("Every size from 1e-9 to 1e8 of a scene shows the same picture by every method", "[hard][merge]") {
    for (const char* name : {"cornell", "lens", "two-lights", "textured-room"})
        check_sizes(shipped_scene(name), kEstimators);
    check_sizes(cornell_with_stained_glass(), kEstimators);
}

TEST_CASE("A closed room keeps its light a million of its sizes from the origin", "[hard]") {
    for (const float place : {1e5f, 1e6f, 4e6f, 1e8f}) {
        // Whole numbers, as floats hold them there.
        SceneDescription scene = moved(scaled(furnace_scene(0.5f, 0.5f), 4.0f * max_of(1.0f, place / 4e6f)),
                                       place * Vec3f{1.0f, -1.0f, 1.0f});
        INFO("at " << place);
        move_into_float_range(scene);
        CHECK(!scene.warnings.empty());
        check_equilibrium(scene, 0);
    }
}

TEST_CASE("Rooms ten thousand of their sizes away from the origin lose no ray and no light", "[hard]") {
    for (const float place : {1e2f, 1e3f, 1e4f}) {
        INFO("at " << place);
        check_equilibrium(moved(furnace_scene(0.5f, 0.5f), place * Vec3f{0.7f, -0.5f, 0.4f}), 0);
    }
}

// A plate in front of a plate: the gap is 64 spacings of the coordinates and 64 roundoffs of the extent.
TEST_CASE("Rays that leave a plate meet the next one, however narrow the gap", "[hard]") {
    Uniforms random(41);
    for (const float place : {0.0f, 1.0f, 1e3f, 1e5f})
        for (const float extent : {1.0f, 1e3f}) {
            const float gap = 64.0f * (next_float_up(place + extent) - (place + extent)) + 64.0f * kRoundoff * extent;
            SceneDescription scene;
            scene.materials.push_back(gray());
            const float y = place;
            for (const float height : {y, y + gap})
                add_own_quad(scene,
                             {Vec3f{place - extent, height, place - extent},
                              {place - extent, height, place + extent},
                              {place + extent, height, place + extent},
                              {place + extent, height, place - extent}},
                             0);
            const HostScene packed = pack_scene(scene);
            const SceneView view = packed.view();
            const BvhIntersector intersector{view};
            std::uint64_t through = 0;
            std::uint64_t rays = 0;
            for (int i = 0; i < 50000; ++i) {
                // Near the middle, so that rays which do not graze stay between the plates.
                const Hit hit{
                    .t = 1.0f, .primitive = 0, .b1 = random.between(0.2f, 0.4f), .b2 = random.between(0.2f, 0.4f)};
                const SurfacePoint point = make_surface_point<FeatureSet{}>(view, hit, {0.0f, 1.0f, 0.0f});
                const Vec3f direction = lambert_sample(point, random.square());
                const Vec3f end = point.position + (gap / max_of(direction.y, 1e-6f)) * direction;
                const float reach = max_of(std::fabs(end.x - place), std::fabs(end.z - place));
                if (direction.y < 0.1f || reach > 0.9f * extent) continue;  // may pass beside the other plate
                const Hit next = intersector.closest_hit(spawn_ray(point, direction));
                through += next.found() && next.primitive >= 2 ? 0 : 1;
                ++rays;
            }
            INFO("at " << place << ", extent " << extent << ", gap " << gap << ", " << rays << " rays");
            CHECK(within(static_cast<double>(through), 0.0));
            CHECK(rays > 20000);
        }
}
