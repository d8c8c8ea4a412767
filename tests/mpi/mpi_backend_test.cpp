// Sessions over several ranks: films, tables and counters have the bits of one rank.
#include "mpi/mpi_backend.h"

#include "core/base/error.h"
#include "core/io/checkpoint_file.h"
#include "tests/core/session/interruption.h"
#include "tests/mpi/thread_ranks.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/input_error.h"
#include "tests/support/files/temporary_folder.h"
#include "tests/support/scenes/image_scenes.h"
#include "tests/support/scenes/instanced_scenes.h"
#include "tests/support/scenes/shapes.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

namespace {

struct Size {
    int ranks;
    int threads;
};

Session over(ThreadRanks& ranks, const SceneDescription& scene, const RenderSettings& settings, int threads = 1) {
    return Session(ranks.backend(threads), std::make_shared<const SceneDescription>(scene), settings);
}

/// With refinement, whose first round follows 8 passes.
RenderSettings refining_settings(const SceneDescription& scene, Estimator estimator) {
    RenderSettings settings = small_settings(scene, estimator);
    settings.field.refine_share = 0.5f;
    return settings;
}

void check_ranks(std::initializer_list<Size> sizes, std::uint32_t passes) {
    // The Cornell box shows its lamp, whose border is looked for in the passes 2 to 5.
    const SceneDescription scene = shipped_scene("cornell");
    for (const Estimator estimator : kEstimators) {
        const RenderSettings settings = refining_settings(scene, estimator);
        Session one = make_session(scene, settings, 2);
        render_passes(one, passes);
        const State expected = state_of(one);
        for (const Size size : sizes) {
            INFO(estimator << ", " << size.ranks << " ranks of " << size.threads << " threads");
            ThreadRanks ranks(size.ranks);
            Session session = over(ranks, scene, settings, size.threads);
            render_passes(session, passes);
            CHECK(same_state(expected, state_of(session)));
            CHECK(session.refinement() == one.refinement());
        }
    }
}

/// Checks that six passes over ranks have the bits of one process, which is returned.
Session check_six_passes(int count, const SceneDescription& scene, const RenderSettings& settings) {
    Session one = make_session(scene, settings, 2);
    render_passes(one, 6);
    ThreadRanks ranks(count);
    Session session = over(ranks, scene, settings);
    render_passes(session, 6);
    CHECK(same_state(state_of(one), state_of(session)));
    return one;
}

}  // namespace

TEST_CASE("Any number of ranks and threads gives the bits of one rank") { check_ranks({{2, 1}, {3, 2}, {8, 2}}, 9); }

TEST_CASE("Any number of ranks and threads gives the bits of one rank, over more passes", "[merge]") {
    check_ranks({{2, 2}, {3, 1}, {5, 1}, {5, 2}, {8, 1}}, 33);
}

TEST_CASE("Scenes that need every effect, and instances, have the bits of one rank") {
    for (const SceneDescription& scene : {every_effect(), room_of_instances(materials_of_meshes())})
        for (const Estimator estimator : {kEstimators[1], kEstimators[5]}) {
            INFO(scene.name << ", " << estimator);
            check_six_passes(3, scene, small_settings(scene, estimator));
        }
}

// Through a lens the borders of lamps are found by comparing pixels with their neighbors, most of which other ranks have here.
TEST_CASE("Borders of lamps are found across the borders of shares") {
    const SceneDescription scene = shipped_scene("cornell");
    RenderSettings settings = small_settings(scene, {MethodId::Default, true});
    settings.camera.aperture_radius = 0.05f;
    settings.camera.focus_distance = 1.0f;
    const Session one = check_six_passes(24, scene, settings);
    CHECK(one.snapshot(slot_of(one)).counters.path.emission_rays > 6 * 61 * 47);
}

// By their own samples in small pictures, and by blocks of pixels in larger ones.
TEST_CASE("The choice of guiding is that of one rank") {
    const SceneDescription scene = shipped_scene("cornell");
    for (const int side : {64, 256}) {
        INFO(side);
        RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, true}, side, side);
        settings.guiding = GuidingRule::Paying;
        Session one = make_session(scene, settings, 2);
        ThreadRanks ranks(3);
        Session session = over(ranks, scene, settings);
        const std::uint32_t passes = side == 64 ? 13 : 4;
        render_passes(one, passes);
        render_passes(session, passes);
        CHECK(same_state(state_of(one), state_of(session)));
        CHECK(one.guiding_status(slot_of(one))->variance_ratio ==
              session.guiding_status(slot_of(session))->variance_ratio);
    }
}

TEST_CASE("Every view has the bits of one rank") {
    const SceneDescription scene = shipped_scene("door");
    ThreadRanks ranks(3);
    for (const ViewInfo& view : all_views()) {
        INFO(view.name);
        RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, false});
        settings.view = view.id;
        Session one = make_session(scene, settings, 1);
        Session session = over(ranks, scene, settings);
        render_passes(one, 4);
        render_passes(session, 4);
        CHECK(same_bits(one.snapshot(slot_of(one)).pixels, session.snapshot(slot_of(session)).pixels));
    }
}

TEST_CASE("A picture of several blocks is stopped between them, and goes on to the bits of one rank") {
    const SceneDescription scene = shipped_scene("cornell");
    Uniforms random(3);
    const RenderSettings settings = small_settings(scene, {MethodId::Default, true}, 500, 400);
    Session one = make_session(scene, settings, 2);
    render_passes(one, 3);
    int partial = 0;
    while (partial == 0) {
        ThreadRanks ranks(2);
        Session session = over(ranks, scene, settings);
        while (session.passes(slot_of(session)) < 3) {
            advance_interrupted(session, random.next());
            partial += pass_is_partial(session) ? 1 : 0;
        }
        CHECK(same_state(state_of(one), state_of(session)));
    }
}

TEST_CASE("A session that is taken out goes on with another number of ranks, to the same bits") {
    const SceneDescription scene = shipped_scene("cornell");
    for (const Estimator estimator : {kEstimators[1], kEstimators[2], kEstimators[5]}) {
        INFO(estimator);
        const RenderSettings settings = refining_settings(scene, estimator);
        Session one = make_session(scene, settings, 2);
        render_passes(one, 10);
        const TemporaryFolder folder;
        const std::filesystem::path file = folder.path() / "c";
        std::uint32_t passes = 0;
        for (const int size : {3, 1, 2, 5}) {
            ThreadRanks ranks(size);
            Session session = over(ranks, scene, settings);
            if (passes > 0) session.restore_state(read_checkpoint(file).state);
            passes += size == 5 ? 4 : 2;
            while (session.passes(slot_of(session)) < passes) session.advance(slot_of(session));
            write_checkpoint(file, {.seconds = 0.0, .state = session.save_state()});
            if (passes == 10) CHECK(same_state(state_of(one), state_of(session)));
        }
    }
}

TEST_CASE("A field moves between ranks and a session without them, its pending samples once") {
    const SceneDescription scene = shipped_scene("door");
    const RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, false});
    Session one = make_session(scene, settings, 2);
    ThreadRanks ranks(3);
    Session session = over(ranks, scene, settings);
    // The last of 17 passes waits for an update, so its training samples move as pending sums.
    render_passes(one, 17);
    render_passes(session, 17);
    one.import_field(one.export_field(MethodId::Reinforcement));
    session.import_field(session.export_field(MethodId::Reinforcement));
    render_passes(one, 4);
    render_passes(session, 4);
    CHECK(same_state(state_of(one), state_of(session)));
}

TEST_CASE("The failure of a rank is told with its number, and the job can be ended") {
    ThreadRanks ranks(3, [](const std::string& name, int threads) {
        if (name == "cpu2") throw Error(ErrorKind::Unavailable, "no device");
        return small_batches(name, threads);
    });
    CHECK(error_message(ErrorKind::Unavailable, [&] { ranks.backend(1); }) == "rank 2 (thread): no device");
}

TEST_CASE("Few training samples are sent as a list, many as whole arrays") {
    const SceneDescription scene = shipped_scene("cornell");
    RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, false}, 8, 8);
    settings.field.volumes = 500;
    const auto bytes_of_update = [&](int side) {
        ThreadRanks ranks(2);
        settings.width = settings.height = side;
        Session session = over(ranks, scene, settings);
        render_passes(session, 1);
        const std::uint64_t before = ranks.first().traffic().bytes_sent;
        render_passes(session, 1);
        return ranks.first().traffic().bytes_sent - before;
    };
    const std::uint64_t dense = 500u * 64u * (sizeof(std::int64_t) + sizeof(std::uint32_t));
    CHECK(bytes_of_update(8) < dense / 2);
    CHECK(bytes_of_update(256) > dense / 2);
}
