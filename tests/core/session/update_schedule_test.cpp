// The schedule of updates, and pending training samples when a session is edited, saved or moved.
#include "core/session/update_schedule.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "core/io/field_file.h"
#include "tests/core/session/interruption.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/temporary_folder.h"
#include "tests/support/scenes/shapes.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

namespace {

template <class T, class Allocator>
std::uint64_t sum(const std::vector<T, Allocator>& values) {
    return std::accumulate(values.begin(), values.end(), std::uint64_t{0});
}

/// A session stopped in its first pass, after an update.
Session stopped_in_first_pass(const SceneDescription& scene) {
    Uniforms random(1);
    for (int attempt = 0; attempt < 20; ++attempt) {
        Session session = make_session(scene, small_settings(scene, kLearningPaths, 300, 200), 2);
        while (session.passes(slot_of(session)) == 0) {
            advance_interrupted(session, random.next());
            if (pass_is_partial(session) &&
                sum(tables_of(session.export_field(session.settings().method).field).visits) > 0)
                return session;
        }
    }
    FAIL("no first pass could be stopped");
    throw std::logic_error("unreachable");
}

std::uint64_t waiting_records(const Session& session) {
    return sum(tables_of(session.export_field(session.settings().method).field).pending_count);
}

}  // namespace

TEST_CASE("Tables are updated whenever the number of passes has doubled, and without light samples once in between") {
    for (const bool samples_lights : {true, false}) {
        std::vector<std::uint32_t> updates;
        for (std::uint32_t passes = 1; passes <= 4096; ++passes)
            if (is_updated_after(passes, samples_lights)) updates.push_back(passes);
        std::vector<std::uint32_t> expected{1};
        for (std::uint32_t octave = 2; octave <= 4096; octave *= 2) {
            expected.push_back(octave);
            if (!samples_lights && octave < 4096) expected.push_back(octave + octave / 2);
        }
        CHECK(updates == expected);
        CHECK(is_updated_after(0x80000000u, samples_lights));
        CHECK(is_updated_after(0xc0000000u, samples_lights) == !samples_lights);
    }
}

TEST_CASE(
    "With enough samples a quarter of the passes train, at most sixteen together, the last ones before each update") {
    for (const bool samples_lights : {true, false}) {
        const std::uint32_t first = samples_lights ? 8 : 16;
        std::uint32_t training = 0, changes = 0;
        for (std::uint32_t pass = 0; pass < 4096; ++pass) {
            INFO("pass " << pass);
            CHECK(is_trained_by(pass, samples_lights, false));
            const bool trains = is_trained_by(pass, samples_lights, true);
            if (pass < first) CHECK(trains);
            if (is_updated_after(pass + 1, samples_lights)) CHECK(trains);
            if (pass == 0) continue;
            training += trains ? 1u : 0u;
            changes += trains != is_trained_by(pass - 1, samples_lights, true) ? 1u : 0u;
        }
        // All of the first 8 or 16; then, in each octave, 2 of 8, 4 of 16, 8 of 32, 16 of 64, and 16 or 32 of the others.
        CHECK(training == (samples_lights ? 7 + 2 + 4 + 8 + 16 + 16 * 5 : 15 + 4 + 8 + 16 + 32 * 5));
        // So that a back end may render the passes of either kind at once.
        CHECK(changes == (samples_lights ? 2u * 9 : 4u * 8));
    }
}

TEST_CASE("A field with enough samples makes training samples in few passes, whatever the threads and "
          "interruptions") {
    const SceneDescription scene = shipped_scene("door");
    const RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, true}, 150, 120);
    Session session = make_session(scene, settings, 2);
    const auto records = [&] {
        const auto status = session.field_status(MethodId::Reinforcement);  // none before the first pass
        return status ? status->records : 0;
    };
    const auto is_well_trained = [&] {
        return session.export_field(MethodId::Reinforcement).progress.is_well_trained;
    };
    std::uint64_t before = 0;
    do {
        before = records();
        render_passes(session, 1);
        REQUIRE(records() > before);
    } while (!is_well_trained());
    CHECK(records() >= kEnoughSamplesPerVolume * 60);
    const std::uint32_t enough = std::max(session.passes(slot_of(session)), 16u);
    REQUIRE(enough < 40);
    render_passes(session, enough - session.passes(slot_of(session)));
    for (std::uint32_t pass = enough; pass < enough + 17; ++pass) {
        before = records();
        render_passes(session, 1);
        INFO("pass " << pass);
        CHECK((records() > before) == is_trained_by(pass, true, true));
    }
    Session interrupted = make_session(scene, settings, 1);
    Uniforms random(2);
    while (interrupted.passes(slot_of(interrupted)) < enough + 17) advance_interrupted(interrupted, random.next());
    CHECK(same_state(state_of(interrupted), state_of(session)));

    session.apply(EditForgetVolume{MethodId::Reinforcement, 0});
    for (int pass = 0; pass < 3; ++pass) {
        before = records();
        render_passes(session, 1);
        CHECK(records() > before);  // the volume learns again
    }
    // Soon: the next update of a film so long may be as many passes away as it has.
    render_passes(session, kMostTrainingPasses);
    CHECK(tables_of(session.export_field(MethodId::Reinforcement).field).mean_radiance[0] > 0.0f);
}

TEST_CASE("The first pass is parted after as many paths as there are volumes, then wherever they have doubled") {
    CHECK(end_of_first_part(0, 16384, 1000) == 1024);
    CHECK(end_of_first_part(1023, 16384, 1000) == 1024);
    CHECK(end_of_first_part(1024, 16384, 1000) == 2048);
    CHECK(end_of_first_part(5000, 16384, 1000) == 8192);
    CHECK(end_of_first_part(8192, 16384, 1000) == 16384);
    CHECK(end_of_first_part(8192, 10000, 1000) == 10000);
    CHECK(end_of_first_part(0, 1000, 1) == 1000);  // too few paths for an update
    CHECK(end_of_first_part(0, 100000, 1) == kFewestPathsBeforeUpdate);
    CHECK(end_of_first_part(0, 100000, 20000) == 32768);
    CHECK(end_of_first_part(0, 100000, 1024) == 1024);
    CHECK(end_of_first_part(0, 0xffffffffu, 0x80000001u) == 0xffffffffu);
    CHECK(end_of_first_part(0xfffffffeu, 0xffffffffu, 1) == 0xffffffffu);
}

TEST_CASE("The first pass is guided by its own first paths, later ones by whole passes") {
    const SceneDescription scene = shipped_scene("door");
    Session session = stopped_in_first_pass(scene);
    REQUIRE(session.passes(slot_of(session)) == 0);
    const HostTables published = tables_of(session.export_field(session.settings().method).field);
    CHECK(published.mean_radiance !=
          make_arrays<HostTables>(session.export_field(session.settings().method).shape, 60).mean_radiance);
    CHECK(sum(published.visits) + sum(published.pending_count) ==
          session.field_status(session.settings().method)->records);
    // Stopped and resumed, the pass has the same bits.
    while (session.passes(slot_of(session)) == 0) session.advance(slot_of(session));
    Session whole = make_session(scene, session.settings(), 1);
    whole.advance(slot_of(whole));
    CHECK(same_state(state_of(whole), state_of(session)));
    CHECK(session.export_field(session.settings().method).progress.passes == 1);
}

// Paths that draw the random numbers of the tables' own training samples are biased.
TEST_CASE("Random numbers of training samples are not drawn again for another picture") {
    const SceneDescription scene = shipped_scene("door");
    Session session = stopped_in_first_pass(scene);
    const LearnedField half_way = session.export_field(session.settings().method);
    CHECK(half_way.progress.passes == 1);
    session.apply(EditRestart{});
    render_passes(session, 1);
    CHECK(session.film_origin(slot_of(session)).warm);
    CHECK(session.export_field(session.settings().method).progress.passes == 2);

    Session other = make_session(scene, session.settings(), 2);
    other.import_field(half_way);
    render_passes(other, 1);
    CHECK(same_bits(session.snapshot(slot_of(session)).pixels, other.snapshot(slot_of(other)).pixels));
    Session fresh = make_session(scene, session.settings(), 2);
    render_passes(fresh, 1);
    CHECK_FALSE(same_bits(session.snapshot(slot_of(session)).pixels, fresh.snapshot(slot_of(fresh)).pixels));
}

TEST_CASE("Training samples stay pending until the tables are updated, and none is lost") {
    const SceneDescription scene = shipped_scene("door");
    Session session = make_session(scene, small_settings(scene, kLearningPaths), 2);
    for (std::uint32_t pass = 1; pass <= 16; ++pass) {
        render_passes(session, 1);
        INFO("after pass " << pass);
        const std::uint64_t waiting = waiting_records(session);
        CHECK((waiting == 0) == is_updated_after(pass, kLearningPaths.next_event));
        CHECK(sum(tables_of(session.export_field(session.settings().method).field).visits) + waiting ==
              session.field_status(session.settings().method)->records);
    }
}

TEST_CASE("A picture that begins anew updates the tables after its first pass, with the samples that were pending") {
    const SceneDescription scene = shipped_scene("door");
    Session session = make_session(scene, small_settings(scene, kLearningPaths), 2);
    render_passes(session, 13);
    REQUIRE(waiting_records(session) > 0);
    session.apply(EditRestart{});
    render_passes(session, 1);
    CHECK(waiting_records(session) == 0);
    CHECK(sum(tables_of(session.export_field(session.settings().method).field).visits) ==
          session.field_status(session.settings().method)->records);
}

TEST_CASE("Pending training samples are saved and loaded with the tables") {
    const SceneDescription scene = shipped_scene("door");
    const RenderSettings settings = small_settings(scene, kLearningPaths);
    Session first = make_session(scene, settings, 2);
    render_passes(first, 13);
    const LearnedField field = first.export_field(first.settings().method);
    REQUIRE(sum(tables_of(field.field).pending_count) > 0);
    const TemporaryFolder folder;
    write_field(folder.path() / "field", field);

    Session second = make_session(scene, settings, 1);
    second.import_field(read_field(folder.path() / "field"));
    CHECK(waiting_records(second) == sum(tables_of(field.field).pending_count));
    first.apply(EditRestart{});
    render_passes(first, 2);
    render_passes(second, 2);
    CHECK(same_state(state_of(first), state_of(second)));
}

TEST_CASE("A run goes on in the sequences of the last one like it, unless guiding has changed or halves would be "
          "exchanged") {
    const PassRun spread{.first_pass = 0, .first_sample = 10, .sequences = {20, 10}};
    const PassRun training{.first_pass = 4, .first_sample = 14, .sequences = {28, 14}, .trains = true};
    const PassRun next{.first_pass = 6, .first_sample = 16};
    CHECK(next.sequences_behind(std::vector{spread, training}) == VertexSequences{20, 12});  // four members are drawn
    const PassRun odd{.first_pass = 5, .first_sample = 15};
    CHECK(odd.sequences_behind(std::vector{spread, training}) == odd.own_sequences());
    const PassRun unguided{.first_pass = 4, .first_sample = 14, .sequences = {28, 14}, .is_guided = false};
    CHECK(next.sequences_behind(std::vector{spread, unguided}) == next.own_sequences());
    // Behind a question: its passes have sequences of their own, whichever method they are of.
    PassRun other = unguided;
    other.decides = true;
    CHECK(next.sequences_behind(std::vector{spread, other}) == VertexSequences{20, 12});
    CHECK(next.sequences_behind({}) == next.own_sequences());
}

TEST_CASE("Passes that train draw from new sequences after every update, and those of a frozen field from one") {
    const SceneDescription scene = shipped_scene("door");
    Session session = make_session(scene, small_settings(scene, kLearningPaths), 2);
    const auto run_of = [&](std::uint32_t pass) { return session.pass_replay(slot_of(session)).run_of(pass); };
    render_passes(session, 13);
    for (std::uint32_t pass = 0, first = 0; pass < 13; ++pass) {
        if (is_updated_after(pass, kLearningPaths.next_event)) first = pass;
        INFO("pass " << pass);
        CHECK(run_of(pass) == PassRun{.first_pass = first,
                                      .first_sample = 8 + first,
                                      .sequences = {2 * (8 + first), 8 + first},
                                      .trains = true});
    }
    session.apply(EditLearning{MethodId::Reinforcement, LearningControl::Freeze});
    render_passes(session, 7);
    for (std::uint32_t pass = 13; pass < 20; ++pass)
        CHECK(run_of(pass) == PassRun{.first_pass = 13, .first_sample = 21, .sequences = {42, 21}});

    // A pass that trains, in between: its sample is not a member of the others' sequences, which exchange no halves.
    session.apply(EditLearning{MethodId::Reinforcement, LearningControl::Step});
    render_passes(session, 2);
    CHECK(run_of(20).trains);
    CHECK(run_of(20).sequences == VertexSequences{56, 28});
    CHECK(run_of(21).sequences == VertexSequences{58, 29});
}

TEST_CASE("Methods that do not learn draw from one pair of sequences through all passes") {
    const SceneDescription scene = shipped_scene("door");
    for (const MethodId method : {MethodId::Default, MethodId::Precomputed}) {
        Session session = make_session(scene, small_settings(scene, {method, false}), 2);
        render_passes(session, 9);
        for (const PassRun& run : session.pass_replay(slot_of(session)).runs)
            CHECK(run.sequences == VertexSequences{});
    }
}
