// Changes of the back end: learned tables move exactly, films are parked with their back end, and a back end that
// fails leaves the session unchanged.
#include <functional>

#include "tests/core/session/failing_backend.h"
#include "tests/core/session/interruption.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/input_error.h"
#include "tests/support/scenes/shapes.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

namespace {

/// Small batches, so that passes stop soon after the flag is raised.
std::shared_ptr<RenderBackend> cpu_backend(int threads) {
    return make_cpu_backend({.threads = threads, .batch_paths = 32});
}

Session session_on(std::shared_ptr<RenderBackend> backend, const SceneDescription& scene,
                   const RenderSettings& settings) {
    return Session(std::move(backend), std::make_shared<const SceneDescription>(scene), settings);
}

using Failure = FailingBackend::Failure;

/// The session has the state of a new session after this many passes with these settings.
void check_like_fresh(Session& session, const SceneDescription& scene, const RenderSettings& settings,
                      std::uint32_t passes) {
    Session fresh = session_on(cpu_backend(2), scene, settings);
    render_passes(fresh, passes);
    CHECK(same_state(state_of(fresh), state_of(session)));
}

std::string unavailable(const std::function<void()>& call) { return error_message(ErrorKind::Unavailable, call); }

}  // namespace

TEST_CASE("Another back end goes on with the same tables, on a picture of its own") {
    const SceneDescription scene = shipped_scene("door");
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        const RenderSettings settings = small_settings(scene, estimator);
        const auto first = cpu_backend(1);
        const auto second = cpu_backend(7);
        Session session = session_on(first, scene, settings);
        Session reference = session_on(cpu_backend(2), scene, settings);
        render_passes(session, 2);
        render_passes(reference, 2);
        const State parked = state_of(session);
        CHECK(same_state(parked, state_of(reference)));

        session.apply(EditBackend{second});
        CHECK(session.backend().threads == 7);
        CHECK(session.passes(slot_of(session)) == 0);
        CHECK(same_bits(state_of(session).tables, parked.tables));
        reference.apply(EditRestart{});  // a picture of its own
        for (int pass = 0; pass < 2; ++pass) {
            render_passes(session, 1);
            render_passes(reference, 1);
            CHECK(same_state(state_of(session), state_of(reference)));
        }

        const State on_second = state_of(session);
        session.apply(EditBackend{first});
        CHECK(same_film(parked, state_of(session)));
        CHECK(same_events(parked.snapshot.counters, session.snapshot(slot_of(session)).counters));
        CHECK(same_bits(state_of(session).tables, on_second.tables));
        render_passes(session, 1);
        CHECK(session.passes(slot_of(session)) == 3);
        session.apply(EditBackend{second});
        CHECK(same_film(on_second, state_of(session)));
        CHECK(session.passes(slot_of(session)) == 2);
    }
}

// The picture restarts at the end, so that all of it comes from the moved tables.
TEST_CASE("A radiance map is the same however often the back end changes in the middle of it") {
    const SceneDescription scene = shipped_scene("door");
    const RenderSettings settings = small_settings(scene, {MethodId::Precomputed, true});
    Session whole = session_on(cpu_backend(2), scene, settings);
    render_passes(whole, 1);
    Uniforms random(1);
    int moved = 0;
    for (int run = 0; run < 5000 && moved < 5; ++run) {
        const std::array backends{cpu_backend(1), cpu_backend(2), cpu_backend(3)};
        Session session = session_on(backends[0], scene, settings);
        for (std::size_t next = 1; session.passes(slot_of(session)) == 0; ++next) {
            advance_interrupted(session, random.next());
            moved += slice_is_partial(session) ? 1 : 0;
            session.apply(EditBackend{backends[next % backends.size()]});
        }
        session.apply(EditRestart{});
        render_passes(session, 1);
        CHECK(same_state(state_of(whole), state_of(session)));
    }
    CHECK(moved >= 5);
}

// The pass is incomplete when the back end changes and comes back: the picture and the sums are complete at its end.
TEST_CASE("A pass that was parked with its back end is finished with the same bits") {
    const SceneDescription scene = shipped_scene("door");
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        RenderSettings settings = small_settings(scene, estimator);
        settings.width = 128;
        Session whole = session_on(cpu_backend(2), scene, settings);
        render_passes(whole, 3);
        Uniforms random(1);
        int moved = 0;
        for (int run = 0; run < 5000 && moved < 3; ++run) {
            const auto first = cpu_backend(2);
            const auto second = cpu_backend(1);
            Session session = session_on(first, scene, settings);
            while (session.passes(slot_of(session)) < 2) {
                advance_interrupted(session, random.next());
                if (!pass_is_partial(session)) continue;
                ++moved;
                const State before = state_of(session);
                session.apply(EditBackend{second});
                CHECK(same_bits(before.tables, state_of(session).tables));
                session.apply(EditBackend{first});
                CHECK(same_state(before, state_of(session)));
            }
            while (session.passes(slot_of(session)) < 3) session.advance(slot_of(session));
            CHECK(same_state(state_of(whole), state_of(session)));
        }
        CHECK(moved >= 3);
    }
}

TEST_CASE("The tables of all methods move, and a cleared film or table is cleared on every back end") {
    const SceneDescription scene = shipped_scene("door");
    const RenderSettings settings = small_settings(scene, {MethodId::Precomputed, false});
    const auto first = cpu_backend(1);
    Session session = session_on(first, scene, settings);
    RenderSettings fresh_settings = settings;
    fresh_settings.method = MethodId::Reinforcement;
    const FilmSlot learning = slot_of(fresh_settings);
    render_passes(session, 1);
    render_passes(session, learning, 2);
    std::array<HostTables, kMethodCount> tables;
    for (const MethodInfo& method : all_methods())
        tables[static_cast<std::size_t>(method.id)] = tables_of(first->download_field(method.id));
    const auto second = cpu_backend(2);
    session.apply(EditBackend{second});
    for (const MethodInfo& method : all_methods()) {
        CHECK(second->has_field(method.id) == method.uses_field);
        CHECK(same_bits(tables[static_cast<std::size_t>(method.id)], tables_of(second->download_field(method.id))));
    }

    session.apply(EditForget{});
    session.apply(EditBackend{first});
    CHECK(session.passes(learning) == 0);
    render_passes(session, learning, 1);
    Session fresh = session_on(cpu_backend(2), scene, fresh_settings);
    render_passes(fresh, 1);
    CHECK(same_state(state_of(fresh), state_of(session, learning)));
}

// Volumes are placed again by the next pass, not before: until then the tables of the parked back end belong to no placement.
TEST_CASE("A field that was cleared on one back end is not carried on by another") {
    const SceneDescription scene = shipped_scene("door");
    const RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, false});
    const auto first = cpu_backend(1);
    const auto second = cpu_backend(2);
    Session session = session_on(first, scene, settings);
    render_passes(session, 2);
    session.apply(EditBackend{second});
    RenderSettings other = settings;
    other.field.volumes = 30;
    other.field.bins = 16;
    session.apply(EditField{other.field});
    session.apply(EditBackend{first});
    session.apply(EditBackend{cpu_backend(3)});
    render_passes(session, 2);
    check_like_fresh(session, scene, other, 2);
}

TEST_CASE("Another scene reaches parked back ends") {
    const SceneDescription scene = shipped_scene("door");
    SceneDescription brighter = scene;
    for (MaterialDescription& material : brighter.materials) material.emission *= 2.0f;
    const RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, true});
    const auto first = cpu_backend(1);
    Session session = session_on(first, scene, settings);
    render_passes(session, 2);
    session.apply(EditBackend{cpu_backend(2)});
    session.apply(EditScene{std::make_shared<const SceneDescription>(brighter)});
    session.apply(EditBackend{first});
    render_passes(session, 2);
    check_like_fresh(session, brighter, settings, 2);
}

TEST_CASE("A back end that cannot take over leaves the session as it was") {
    const SceneDescription scene = shipped_scene("door");
    for (const Estimator estimator : kEstimators) {
        const RenderSettings settings = small_settings(scene, estimator);
        const bool has_field = info_of(estimator.method).uses_field;
        for (const Failure failure : {Failure::Scene, Failure::Volumes, Failure::Tables}) {
            if (!has_field && failure != Failure::Scene) continue;
            INFO(estimator << ", failure " << static_cast<int>(failure));
            const auto first = cpu_backend(2);
            Session session = session_on(first, scene, settings);
            render_passes(session, 2);
            const State before = state_of(session);
            const auto broken = std::make_shared<FailingBackend>();
            broken->failure = failure;
            CHECK_THAT(unavailable([&] { session.apply(EditBackend{broken}); }), contains("gone"));
            CHECK(&session.backend_access() == first.get());
            CHECK(same_state(before, state_of(session)));
            render_passes(session, 1);
            Session undisturbed = session_on(cpu_backend(2), scene, settings);
            render_passes(undisturbed, 3);
            CHECK(same_state(state_of(undisturbed), state_of(session)));
            // It may come back to life.
            broken->failure = Failure::None;
            session.apply(EditBackend{broken});
            CHECK(same_bits(state_of(session).tables, state_of(undisturbed).tables));
        }
    }
}

TEST_CASE("A lost back end is abandoned with its tables, and the next one starts like a new session") {
    const SceneDescription scene = shipped_scene("door");
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        const RenderSettings settings = small_settings(scene, estimator);
        const auto lost = std::make_shared<FailingBackend>();
        Session session = session_on(lost, scene, settings);
        render_passes(session, 2);
        lost->failure = Failure::Pass;
        CHECK_THAT(unavailable([&] { session.advance(slot_of(session)); }), contains("gone"));
        lost->failure = Failure::Download;
        const auto next = cpu_backend(2);
        if (info_of(estimator.method).uses_field)
            CHECK_THAT(unavailable([&] { session.apply(EditBackend{next}); }), contains("gone"));
        const SessionEdit abandon = EditBackend{.backend = next, .abandon_old = true};
        RenderSettings ignored;
        CHECK(take_over(abandon, ignored) == Invalidation{.tables = true});
        session.apply(abandon);
        CHECK(session.passes(slot_of(session)) == 0);
        CHECK_FALSE(next->has_field(estimator.method));
        CHECK(lost.use_count() == 1);  // the session has released it
        render_passes(session, 2);
        Session fresh = session_on(cpu_backend(1), scene, settings);
        render_passes(fresh, 2);
        CHECK(same_state(state_of(fresh), state_of(session)));
    }
}

TEST_CASE("Changing to the back end that runs already changes nothing") {
    const SceneDescription scene = shipped_scene("door");
    const auto backend = cpu_backend(2);
    Session session = session_on(backend, scene, small_settings(scene, {MethodId::Reinforcement, false}));
    render_passes(session, 2);
    const State before = state_of(session);
    session.apply(EditBackend{backend});
    CHECK(same_state(before, state_of(session)));
    CHECK(session.passes(slot_of(session)) == 2);
}
