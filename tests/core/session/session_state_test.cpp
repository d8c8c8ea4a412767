// A session that is taken out, put into a file and continued elsewhere: to the bits of an uninterrupted one.
#include "core/io/checkpoint_file.h"
#include "tests/core/session/interruption.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/input_error.h"
#include "tests/support/files/temporary_folder.h"
#include "tests/support/scenes/shapes.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

namespace {

/// Small batches, so that passes stop soon after the flag is raised.
Session begin(const SceneDescription& scene, const RenderSettings& settings, int threads) {
    return Session(make_cpu_backend({.threads = threads, .batch_paths = 32}),
                   std::make_shared<const SceneDescription>(scene), settings);
}

Session continued(const Session& from, const RenderSettings& settings, int threads) {
    const TemporaryFolder folder;
    write_checkpoint(folder.path() / "c", {.seconds = 1.5, .state = from.save_state()});
    Checkpoint checkpoint = read_checkpoint(folder.path() / "c");
    CHECK(checkpoint.seconds == 1.5);
    Session next = begin(from.scene(), settings, threads);
    next.restore_state(std::move(checkpoint.state));
    return next;
}

struct Interrupted {
    State state;
    int partial = 0;  ///< times that it was taken out within a pass or a slice
};

/// Taken out and continued after each piece of work, most of which are stopped at random moments.
Interrupted render_in_pieces(const SceneDescription& scene, const RenderSettings& settings, std::uint32_t passes,
                             Uniforms& random) {
    Session session = begin(scene, settings, 2);
    Interrupted result;
    for (int threads = 1; session.passes(slot_of(session)) < passes; threads = threads % 3 + 1) {
        advance_interrupted(session, random.next());
        result.partial += pass_is_partial(session) || slice_is_partial(session) ? 1 : 0;
        session = continued(session, settings, threads);
    }
    result.state = state_of(session);
    return result;
}

/// With refinement, whose first round follows 8 passes.
RenderSettings refining_settings(const SceneDescription& scene, Estimator estimator) {
    RenderSettings settings = small_settings(scene, estimator);
    settings.field.refine_share = 0.5f;
    return settings;
}

}  // namespace

// The Cornell box shows its lamp, whose border is looked for in the passes 2 to 5.
TEST_CASE("A session that is taken out at any moment goes on elsewhere with the same bits") {
    const SceneDescription scene = shipped_scene("cornell");
    Uniforms random(1);
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        const RenderSettings settings = refining_settings(scene, estimator);
        const std::uint32_t passes = estimator.method == MethodId::Reinforcement ? 9 : 6;
        Session whole = begin(scene, settings, 2);
        render_passes(whole, passes);
        const State expected = state_of(whole);
        int partial = 0;
        while (partial < 2) {
            const Interrupted pieces = render_in_pieces(scene, settings, passes, random);
            partial += pieces.partial;
            CHECK(same_state(expected, pieces.state));
        }
        if (estimator.method == MethodId::Reinforcement) CHECK(whole.refinement().added > 0);
    }
}

// With light samples the choice between passes of the method and of the baseline is a part of the state, in large pictures its
// warm-up, too.
TEST_CASE("What is known of guiding is continued to the bit") {
    const SceneDescription scene = shipped_scene("door");
    Uniforms random(2);
    for (const int side : {64, 256}) {
        INFO(side);
        RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, true}, side, side);
        settings.guiding = GuidingRule::Paying;
        const std::uint32_t passes = side == 64 ? 13 : 4;
        Session whole = begin(scene, settings, 2);
        render_passes(whole, passes);
        Session session = begin(scene, settings, 2);
        while (session.passes(slot_of(session)) < passes) {
            advance_interrupted(session, random.next());
            session = continued(session, settings, 1);
        }
        CHECK(same_state(state_of(whole), state_of(session)));
        const GuidingStatus expected = whole.guiding_status(slot_of(whole)).value();
        const GuidingStatus got = session.guiding_status(slot_of(session)).value();
        CHECK(expected.variance_ratio == got.variance_ratio);
        CHECK(got.variance_ratio);
        CHECK(expected.pays == got.pays);
    }
}

TEST_CASE("Every view is continued to the bit") {
    const SceneDescription scene = shipped_scene("door");
    for (const ViewInfo& view : all_views()) {
        INFO(view.name);
        RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, false});
        settings.view = view.id;
        Session whole = begin(scene, settings, 1);
        render_passes(whole, 5);
        Session session = begin(scene, settings, 1);
        render_passes(session, 3);
        session = continued(session, settings, 2);
        render_passes(session, 2);
        CHECK(same_bits(whole.snapshot(slot_of(whole)).pixels, session.snapshot(slot_of(session)).pixels));
    }
}

TEST_CASE("Clocks of a continued session go on") {
    const SceneDescription scene = shipped_scene("door");
    const RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, false});
    Session session = begin(scene, settings, 1);
    render_passes(session, 2);
    const Clocks before = session.clocks(slot_of(session));
    session = continued(session, settings, 1);
    const Clocks after = session.clocks(slot_of(session));
    CHECK(after.render == before.render);
    CHECK(after.learn == before.learn);
    CHECK(after.place == before.place);
}

TEST_CASE("A session refuses the state of another run") {
    const SceneDescription scene = shipped_scene("door");
    const RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, true});
    Session session = begin(scene, settings, 1);
    render_passes(session, 1);
    const auto refusal = [&](const SceneDescription& other_scene, const RenderSettings& other) {
        return input_error([&] { begin(other_scene, other, 1).restore_state(session.save_state()); });
    };
    RenderSettings other = settings;
    other.seed = 7;
    CHECK(refusal(scene, other) == "the checkpoint is of another run: seed: expected 7, got 1");
    other = settings;
    other.next_event = false;
    CHECK(refusal(scene, other) == "the checkpoint is of another run: nee: expected off, got on");
    other = settings;
    other.width = 62;
    CHECK(refusal(scene, other) == "the checkpoint is of another run: size: expected 62x47, got 61x47");
    CHECK(refusal(shipped_scene("cornell"), settings).find("scene hash: expected ") != std::string::npos);
}
