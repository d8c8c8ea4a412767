// Sessions that give up guiding where it does not pay: the same bits for any threads and stops, trials leave no trace in the
// film, and rare passes go on learning.
#include "tests/session/interruption.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr std::uint32_t kPasses = 40;

}  // namespace

TEST_CASE("Guiding is given up where it changes nothing but the cost, by both guided methods") {
    const SceneDescription scene = shipped_scene("door");
    for (const MethodId method : {MethodId::Precomputed, MethodId::Reinforcement}) {
        Session session = make_session(scene, settings_without_gain(scene, method));
        render_passes(session, kPasses);
        const auto status = session.guiding_status(slot_of(session));
        REQUIRE(status);
        REQUIRE(status->gain);
        INFO(info_of(method).name << ": " << *status->gain);
        CHECK(*status->gain < 0.9);
        CHECK(*status->gain > 0.5);
        CHECK_FALSE(status->pays);
        CHECK(status->unguided_passes > kPasses / 2);
        CHECK(status->trial_paths == 2 * 40 * 40);
        CHECK(session.snapshot(slot_of(session)).counters.paths == std::uint64_t{kPasses} * 40 * 40);
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

TEST_CASE("Trials leave no trace in film and field") {
    constexpr std::uint32_t kUndecided = 7;  // passes with both trials, before the first decision takes effect
    const SceneDescription scene = shipped_scene("door");
    RenderSettings settings = settings_without_gain(scene, MethodId::Reinforcement);
    Session session = make_session(scene, settings);
    render_passes(session, kUndecided);
    CHECK(session.guiding_status(slot_of(session))->trial_paths > 0);
    settings.guiding = GuidingRule::Always;
    Session always = make_session(scene, settings);
    render_passes(always, kUndecided);
    State with = state_of(session);
    const State without = state_of(always);
    with.snapshot.counters.variance = without.snapshot.counters.variance;
    CHECK(same_state(with, without));
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
    CHECK(three.guiding_status(slot_of(three))->gain == one.guiding_status(slot_of(one))->gain);
    Session stopped = make_session(scene, settings, 2);
    int stops = 0;
    for (int i = 0; stopped.passes(slot_of(stopped)) < kPasses; ++i) {
        StopFlag stop = true;
        if (i % 2 == 0)
            stops += stopped.advance(slot_of(stopped), &stop) == Progress::Stopped ? 1 : 0;
        else
            advance_interrupted(stopped, 0.6f);
    }
    CHECK(stops > 0);
    CHECK(same_state(expected, state_of(stopped)));
}

TEST_CASE("A field goes on learning in the rare guided passes") {
    const SceneDescription scene = shipped_scene("door");
    Session session = make_session(scene, settings_without_gain(scene, MethodId::Reinforcement));
    render_passes(session, kPasses);
    const std::uint64_t records = session.field_status(MethodId::Reinforcement)->records;
    const std::uint32_t unguided = session.guiding_status(slot_of(session))->unguided_passes;
    render_passes(session, 400);
    CHECK(session.field_status(MethodId::Reinforcement)->records > records);
    CHECK(session.guiding_status(slot_of(session))->unguided_passes > unguided + 300);
    CHECK(session.field_status(MethodId::Reinforcement)->passes ==
          kPasses + 400 - session.guiding_status(slot_of(session))->unguided_passes);
}

TEST_CASE("A replay knows the passes that were not guided") {
    const SceneDescription scene = shipped_scene("door");
    Session session = make_session(scene, settings_without_gain(scene, MethodId::Reinforcement));
    render_passes(session, kPasses);
    const PassReplay replay = session.pass_replay(slot_of(session));
    std::uint32_t unguided = 0;
    for (std::uint32_t pass = 0; pass < kPasses; ++pass) unguided += replay.is_guided(pass) ? 0u : 1u;
    CHECK(replay.is_guided(0));
    CHECK(unguided == session.guiding_status(slot_of(session))->unguided_passes);
}
