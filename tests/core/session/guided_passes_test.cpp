// Sessions that give up guiding where it does not pay: passes by both methods in one film, with the same bits for any threads and stops.
#include <algorithm>
#include <vector>

#include "core/scene/pack_scene.h"
#include "core/session/path_settings.h"
#include "tests/core/session/interruption.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr std::uint32_t kPasses = 20;

/// Of the least size whose warm-up has one pass of each role.
RenderSettings large_picture(RenderSettings settings) {
    settings.width = settings.height = 256;
    return settings;
}

}  // namespace

TEST_CASE("Guiding is given up where it changes nothing but the cost, by both guided methods") {
    const SceneDescription scene = shipped_scene("door");
    for (const MethodId method : {MethodId::Precomputed, MethodId::Reinforcement}) {
        Session session = make_session(scene, settings_without_gain(scene, method));
        render_passes(session, kPasses);
        const auto status = session.guiding_status(slot_of(session));
        REQUIRE(status);
        REQUIRE(status->variance_ratio);
        INFO(info_of(method).name << ": " << *status->variance_ratio);
        CHECK(*status->variance_ratio < 1.36);
        CHECK(*status->variance_ratio > 0.7);
        CHECK_FALSE(status->pays);
        CHECK(status->unguided_passes == kPasses - 2);
        CHECK(session.snapshot(slot_of(session)).counters.paths == std::uint64_t{kPasses} * 80 * 80);
    }
}

TEST_CASE("Guiding is kept where every pass shall be guided, and by methods without a field") {
    const SceneDescription scene = shipped_scene("door");
    RenderSettings settings = settings_without_gain(scene, MethodId::Reinforcement);
    settings.guiding = GuidingRule::Always;
    Session always = make_session(scene, settings);
    render_passes(always, kPasses);
    CHECK_FALSE(always.guiding_status(slot_of(always)));
    CHECK(always.snapshot(slot_of(always)).counters.path.method.lookups > 0);
    settings.guiding = GuidingRule::Paying;
    settings.next_event = false;
    Session without = make_session(scene, settings);
    CHECK_FALSE(without.guiding_status(slot_of(without)));
    Session plain = make_session(scene, settings_without_gain(scene, MethodId::Default));
    CHECK_FALSE(plain.guiding_status(slot_of(plain)));
}

TEST_CASE("Threads and stops do not change a bit of a film that guiding was given up in") {
    const SceneDescription scene = shipped_scene("door");
    const RenderSettings settings = settings_without_gain(scene, MethodId::Reinforcement);
    Session one = make_session(scene, settings);
    render_passes(one, kPasses);
    const State expected = state_of(one);
    REQUIRE(one.guiding_status(slot_of(one))->unguided_passes > 0);
    Session three = make_session(scene, settings, 3);
    render_passes(three, kPasses);
    CHECK(same_state(expected, state_of(three)));
    CHECK(three.guiding_status(slot_of(three))->variance_ratio == one.guiding_status(slot_of(one))->variance_ratio);
    Session stopped = make_session(scene, settings, 2);
    CHECK(render_with_stops(stopped, kPasses) > 0);
    CHECK(same_state(expected, state_of(stopped)));
}

TEST_CASE("A large picture that guiding does not pay in has one guided pass") {
    constexpr std::uint32_t kFewPasses = 6;
    const SceneDescription scene = shipped_scene("door");
    for (const MethodId method : {MethodId::Precomputed, MethodId::Reinforcement}) {
        INFO(info_of(method).name);
        Session session = make_session(scene, large_picture(settings_without_gain(scene, method)));
        const FilmSlot slot = slot_of(session);
        render_passes(session, kFewPasses);
        const GuidingStatus status = *session.guiding_status(slot);
        CHECK_FALSE(status.pays);
        CHECK(status.unguided_passes == kFewPasses - 1);
        CHECK(session.snapshot(slot).counters.paths == std::uint64_t{kFewPasses} * 256 * 256);
        CHECK(session.field_status(method)->records > 0);
        const PassReplay replay = session.pass_replay(slot);
        for (std::uint32_t pass = 0; pass < kFewPasses; ++pass) CHECK(replay.is_guided(pass) == (pass == 1));
    }
}

TEST_CASE(
    "The map of a large picture stays coarse where guiding does not pay, until it is shown or every pass is guided") {
    const SceneDescription scene = shipped_scene("door");
    const RenderSettings settings = large_picture(settings_without_gain(scene, MethodId::Precomputed));
    const auto whole =
        static_cast<std::uint64_t>(settings.field.volumes * settings.field.bins * settings.field.precompute_samples);
    Session session = make_session(scene, settings, 2);
    const FilmSlot slot = slot_of(session);
    const auto map = [&] { return *session.field_status(slot.method); };
    render_passes(session, slot, 4);
    CHECK(map().records == whole / 4 / 4);  // a quarter of the first of four slices
    CHECK(map().precomputed_share == 1.0 / 16.0);

    SECTION("Its view") { render_passes(session, {slot.method, View::RadianceMap}, 1); }
    SECTION("Every pass") {
        session.apply(EditEstimator{settings.max_depth, settings.next_event, settings.roulette, GuidingRule::Always});
        render_passes(session, slot, 1);
    }
    CHECK(map().records == whole);
    CHECK(map().precomputed_share == 1.0);
}

TEST_CASE("The map of a large picture is completed where guiding pays, whatever stops it") {
    const SceneDescription scene = shipped_scene("staircase");
    RenderSettings settings = large_picture(small_settings(scene, {MethodId::Precomputed, true}));
    settings.guiding = GuidingRule::Paying;
    settings.field.volumes = 800;
    Session whole = make_session(scene, settings, 2);
    render_passes(whole, 2);
    REQUIRE(whole.guiding_status(slot_of(whole))->pays);
    CHECK(whole.field_status(MethodId::Precomputed)->precomputed_share < 1.0);
    render_passes(whole, 2);
    CHECK(whole.field_status(MethodId::Precomputed)->precomputed_share == 1.0);
    CHECK(whole.pass_replay(slot_of(whole)).is_guided(3));
    Session stopped = make_session(scene, settings, 1);
    CHECK(render_with_stops(stopped, 4) > 0);
    CHECK(same_state(state_of(whole), state_of(stopped)));
}

TEST_CASE("A large picture that guiding pays in is guided after its warm-up, and pictures by other cameras from the "
          "first pass on") {
    const SceneDescription scene = shipped_scene("staircase");
    RenderSettings settings = large_picture(small_settings(scene, {MethodId::Reinforcement, true}));
    settings.guiding = GuidingRule::Paying;
    Session session = make_session(scene, settings);
    const FilmSlot slot = slot_of(session);
    render_passes(session, 4);
    const GuidingStatus status = *session.guiding_status(slot);
    CHECK(status.pays);
    REQUIRE(status.variance_ratio);
    CHECK(*status.variance_ratio > 1.3);
    CHECK(status.unguided_passes == 1);
    const PassReplay replay = session.pass_replay(slot);
    for (std::uint32_t pass = 0; pass < 4; ++pass) CHECK(replay.is_guided(pass) == (pass > 0));
    // Weights of 1, 4, 8 and 8.
    CHECK(session.backend_access().read_film(slot).weight == 21u * 256 * 256);
    CameraDescription camera = scene.camera;
    camera.fov_deg *= 0.9f;
    session.apply(EditCamera{camera});
    render_passes(session, 2);
    CHECK(session.guiding_status(slot)->unguided_passes == 0);
    CHECK(session.guiding_status(slot)->pays);
    // A field that is forgotten is asked for again.
    session.apply(EditForget{});
    render_passes(session, 2);
    CHECK(session.guiding_status(slot)->unguided_passes == 1);
}

// Tables that guide a pass are independent of its numbers: no number of a sample comes twice while the field lives.
TEST_CASE("No pass of a learner draws the numbers of another one, whenever a picture is interrupted") {
    const SceneDescription scene = shipped_scene("door");
    RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, true}, 40, 40);
    settings.guiding = GuidingRule::Paying;
    for (const std::uint32_t interrupted : {1u, 3u, 4u, 6u, 9u, 13u}) {
        Session session = make_session(scene, settings);
        std::vector<std::uint32_t> numbers;
        for (const std::uint32_t passes : {interrupted, 14u}) {
            render_passes(session, passes);
            const PassReplay replay = session.pass_replay(slot_of(session));
            for (std::uint32_t pass = 0; pass < replay.samples; ++pass)
                numbers.push_back(replay.schedule.sample_of(pass));
            CameraDescription camera = scene.camera;
            camera.fov_deg *= 0.9f;
            session.apply(EditCamera{camera});
        }
        std::ranges::sort(numbers);
        INFO(interrupted);
        CHECK(numbers.size() == interrupted + 14);
        CHECK(std::ranges::adjacent_find(numbers) == numbers.end());
    }
}

TEST_CASE("Threads and stops do not change a bit of a warm-up and of the film after it") {
    const SceneDescription scene = shipped_scene("door");
    RenderSettings settings = large_picture(small_settings(scene, {MethodId::Reinforcement, true}));
    settings.guiding = GuidingRule::Paying;
    Session one = make_session(scene, settings);
    render_passes(one, 4);
    const State expected = state_of(one);
    Session three = make_session(scene, settings, 3);
    render_passes(three, 4);
    CHECK(same_state(expected, state_of(three)));
    CHECK(three.guiding_status(slot_of(three))->variance_ratio == one.guiding_status(slot_of(one))->variance_ratio);
    Session stopped = make_session(scene, settings, 2);
    for (int i = 0; stopped.passes(slot_of(stopped)) < 4; ++i)
        advance_interrupted(stopped, 0.1f * static_cast<float>(i % 8));
    CHECK(same_state(expected, state_of(stopped)));
    CHECK(stopped.guiding_status(slot_of(stopped))->variance_ratio ==
          one.guiding_status(slot_of(one))->variance_ratio);
}

TEST_CASE("A replay knows the passes that were not guided") {
    const SceneDescription scene = shipped_scene("door");
    Session session = make_session(scene, settings_without_gain(scene, MethodId::Reinforcement));
    render_passes(session, kPasses);
    const PassReplay replay = session.pass_replay(slot_of(session));
    std::uint32_t unguided = 0;
    for (std::uint32_t pass = 0; pass < kPasses; ++pass) unguided += replay.is_guided(pass) ? 0u : 1u;
    CHECK_FALSE(replay.is_guided(0));
    CHECK(replay.is_guided(2));
    CHECK(unguided == session.guiding_status(slot_of(session))->unguided_passes);
}

// In gallery lights are chosen by a learned choice, too.
TEST_CASE("Paths of the baseline that train a field have the bits of those that do not") {
    for (const char* name : {"door", "gallery"}) {
        INFO(name);
        const SceneDescription scene = shipped_scene(name);
        Session session = make_session(scene, small_settings(scene, {MethodId::Reinforcement, true}, 40, 40), 2);
        render_passes(session, 4);
        const RenderSettings& settings = session.settings();
        RenderBackend& backend = session.backend_access();
        PassRequest request{.slot = slot_of(session),
                            .features = kEveryFeature,
                            .path = path_settings(settings, baseline_method()),
                            .camera = make_camera(settings.camera, settings.width, settings.height),
                            .learning = settings.field.learning,
                            .sample = 9};
        request.path.roulette = RouletteRule::Albedo;
        const auto render = [&] {
            backend.reset_film(request.slot, settings.width, settings.height);
            const PassCounters counters = backend.run_pass(request);
            return std::pair(counters.path, backend.read_film(request.slot).mean);
        };
        request.is_guided = false;
        const auto [baseline, expected] = render();
        CHECK(baseline.method.records == 0);
        request.is_guided = true;
        const auto [guided, other] = render();
        CHECK_FALSE(same_bits(other, expected));
        request.mixture = MixtureSettings::unguided();
        const auto [trained, film] = render();
        CHECK(same_bits(film, expected));
        CHECK(trained.segments == baseline.segments);
        CHECK(trained.shadow_rays == baseline.shadow_rays);
        CHECK(trained.method.records > 0);
        request.mixture.learned_lights = 1;
        const auto [lit, by_lights] = render();
        CHECK(same_bits(by_lights, expected) == (std::string_view(name) == "door"));
    }
}
