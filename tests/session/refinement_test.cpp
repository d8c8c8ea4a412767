// Volumes that are split while a method learns: the same ones in every run, however it was interrupted, moved or saved, and
// nothing that was recorded or rendered is lost.
#include <numeric>

#include "tests/session/failing_backend.h"
#include "tests/session/interruption.h"
#include "tests/session/through_file.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/input_error.h"
#include "tests/support/scenes/shapes.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr Estimator kLearning{MethodId::Reinforcement, false};

/// Passes after which the placement was refined for the first time, and for the last.
constexpr std::uint32_t kFirst = 8;
constexpr std::uint32_t kLast = 16;

const SceneDescription& door() {
    static const SceneDescription scene = shipped_scene("door");
    return scene;
}

RenderSettings refining(float share = 0.5f, Estimator estimator = kLearning) {
    RenderSettings settings = small_settings(door(), estimator);
    settings.field.refine_share = share;
    return settings;
}

std::uint64_t known_records(const Session& session) {
    const HostTables tables = session.export_field().tables;
    return std::accumulate(tables.visits.begin(), tables.visits.end(), std::uint64_t{0}) +
           std::accumulate(tables.pending_count.begin(), tables.pending_count.end(), std::uint64_t{0});
}

bool same_sites(const HostVolumes& a, const HostVolumes& b) {
    return std::ranges::equal(a.sites, b.sites, [](const SurfacePoint& p, const SurfacePoint& q) {
        return p.position == q.position && p.geometric_normal == q.geometric_normal;
    });
}

/// The same picture, tables and volumes.
void check_same(Session& a, Session& b) {
    CHECK(same_state(state_of(a), state_of(b)));
    CHECK((a.refinement() == b.refinement()));
    CHECK(same_sites(*a.export_field().volumes, *b.export_field().volumes));
}

}  // namespace

TEST_CASE("Volumes are added after 8 and after 16 passes, up to their share, and no record is lost") {
    for (const float share : {0.1f, 0.5f, 1.0f}) {
        Session session = make_session(door(), refining(share), 2);
        render_passes(session, 1);
        const int placed = session.field_status()->volumes;
        const int most = static_cast<int>(share * static_cast<float>(placed));
        for (std::uint32_t pass = 1; pass <= 20; ++pass) {
            INFO("share " << share << ", after pass " << pass);
            const FieldStatus status = *session.field_status();
            CHECK(status.volumes == placed + status.added_volumes);
            CHECK(status.added_volumes <= (pass < kFirst ? 0 : pass < kLast ? most / 2 : most));
            if (pass >= kFirst) CHECK(status.added_volumes >= most / 2 - 2);
            if (pass >= kLast) CHECK(status.added_volumes >= most - 4);
            CHECK(known_records(session) == status.records);
            render_passes(session, 1);
        }
    }
}

TEST_CASE("Nothing changes before the first volumes are added, nor if none may be") {
    Session off = make_session(door(), refining(0.0f), 2);
    Session on = make_session(door(), refining(0.5f), 2);
    render_passes(off, kFirst - 1);
    render_passes(on, kFirst - 1);
    CHECK(same_state(state_of(off), state_of(on)));
    render_passes(off, 1);
    render_passes(on, 1);
    CHECK(same_film(state_of(off), state_of(on)));  // the pass itself knew nothing of it
    CHECK_FALSE(same_bits(state_of(off).tables, state_of(on).tables));
    render_passes(off, kLast);
    CHECK((off.refinement() == Refinement{}));
    // The budget holds those that were placed, and no more.
    RenderSettings settings = refining(1.0f);
    settings.field.volumes = 0;
    settings.field.budget_megabytes = 60.5 * static_cast<double>(bytes_per_volume(settings.field.bins)) / 1e6;
    Session full = make_session(door(), settings, 2);
    render_passes(full, kLast);
    CHECK(full.field_status()->added_volumes == 0);
    CHECK(full.field_status()->bytes <= static_cast<std::size_t>(1e6 * settings.field.budget_megabytes));
}

TEST_CASE("Without being asked volumes are added where the budget decides, and as many as there are records for") {
    constexpr std::uint64_t kRecordsPerVolume = 32 * 4;
    RenderSettings settings = settings_for(door(), kLearning, 61, 47);
    settings.field.bins = 4;
    Session session = make_session(door(), settings, 2);
    render_passes(session, kFirst - 1);
    const auto placed = static_cast<std::uint64_t>(session.field_status()->volumes);
    CHECK(session.field_status()->added_volumes == 0);
    render_passes(session, 1);
    const FieldStatus few = *session.field_status();
    REQUIRE(few.records / kRecordsPerVolume > placed);
    REQUIRE(few.records / kRecordsPerVolume < placed + placed / 2);
    CHECK(static_cast<std::uint64_t>(few.volumes) <= few.records / kRecordsPerVolume);
    CHECK(static_cast<std::uint64_t>(few.volumes) >= few.records / kRecordsPerVolume - 2);
    render_passes(session, kLast - kFirst);
    const FieldStatus enough = *session.field_status();
    REQUIRE(enough.records / kRecordsPerVolume > 2 * placed);
    CHECK(static_cast<std::uint64_t>(enough.volumes) <= 2 * placed);
    CHECK(static_cast<std::uint64_t>(enough.volumes) >= 2 * placed - 20);
}

TEST_CASE("Without being asked no volume is added in small pictures, nor where their number was asked for") {
    RenderSettings settings = settings_for(door(), kLearning, 30, 20);
    settings.field.bins = 4;
    Session small = make_session(door(), settings, 2);
    render_passes(small, kLast);
    CHECK((small.refinement() == Refinement{.rounds = 2}));
    Session numbered = make_session(door(), refining(kRefineByRecords), 2);
    Session off = make_session(door(), refining(0.0f), 2);
    render_passes(numbered, kLast + 1);
    render_passes(off, kLast + 1);
    CHECK(numbered.field_status()->records > 60 * 64 * 32);
    CHECK(same_state(state_of(off), state_of(numbered)));
}

TEST_CASE("Without being asked volumes are added later, too, when there are records for them") {
    constexpr std::uint64_t kRecordsPerVolume = 96 * 4;
    constexpr std::uint32_t kRounds = 4;  // after 8, 16, 48 and 96 passes
    RenderSettings settings = settings_for(door(), kLearning, 30, 20);
    settings.field.bins = 4;
    Session session = make_session(door(), settings, 2);
    render_passes(session, 191);
    CHECK((session.refinement() == Refinement{.rounds = kRounds}));
    render_passes(session, 1);
    const FieldStatus after = *session.field_status();
    INFO(after.records << " records, " << after.volumes << " volumes, of which " << after.added_volumes
                       << " were added");
    CHECK(after.added_volumes > 0);
    CHECK(after.added_volumes < after.volumes / 2);
    CHECK(static_cast<std::uint64_t>(after.volumes) <= after.records / kRecordsPerVolume);
    CHECK(session.refinement().rounds == kRounds + 1);
}

TEST_CASE("A share that was asked for is added in two rounds") {
    Session session = make_session(door(), refining(), 2);
    render_passes(session, kLast);
    const Refinement added = session.refinement();
    CHECK(added.rounds == 2);
    render_passes(session, 3 * kLast);
    CHECK((session.refinement() == added));
}

TEST_CASE("Neither threads nor lookups nor interruptions change a bit of what refinement makes") {
    Session expected = make_session(door(), refining(), 1);
    render_passes(expected, kLast + 2);
    REQUIRE(expected.refinement().rounds == 2);
    for (const Lookup lookup : {Lookup::Grid, Lookup::KdTree, Lookup::Linear}) {
        RenderSettings settings = refining();
        settings.field.lookup = lookup;
        Session other = make_session(door(), settings, lookup == Lookup::Grid ? 7 : 2);
        render_passes(other, kLast + 2);
        check_same(expected, other);
    }
    Uniforms random(2);
    Session interrupted(make_cpu_backend({.threads = 2, .batch_paths = 32}),
                        std::make_shared<const SceneDescription>(door()), refining());
    int partial = 0;
    while (interrupted.passes() < kLast + 2) {
        if (interrupted.passes() + 1 < kLast + 2)
            advance_interrupted(interrupted, random.next());
        else
            interrupted.advance();
        partial += pass_is_partial(interrupted) ? 1 : 0;
    }
    INFO(partial << " passes were left in part");
    check_same(expected, interrupted);
}

TEST_CASE("A field that is saved before, between or after the rounds goes on with the same bits") {
    for (const std::uint32_t saved : {kFirst - 2, kFirst, kFirst + 3, kLast + 1}) {
        INFO("saved after pass " << saved);
        Session first = make_session(door(), refining(), 2);
        render_passes(first, saved);
        const LearnedField field = through_file(first.export_field());
        CHECK((field.refinement == first.refinement()));
        Session second = make_session(door(), small_settings(door(), kLearning), 1);
        second.import_field(field);
        CHECK(second.field_status()->added_volumes == first.field_status()->added_volumes);
        first.apply(EditRestart{});
        render_passes(first, 12);
        render_passes(second, 12);
        check_same(first, second);
        CHECK(first.refinement().rounds == 2);
    }
}

TEST_CASE("Forgetting what was learned brings back the placement that it refined") {
    const std::vector<SessionEdit> edits{EditForget{}, EditEstimator{.max_depth = 64, .next_event = false},
                                         EditSeed{1}, EditMaterial{0, door().materials[0]}};
    Session fresh = make_session(door(), refining(), 2);
    render_passes(fresh, kFirst + 1);
    for (const SessionEdit& edit : edits) {
        Session session = make_session(door(), refining(), 2);
        render_passes(session, kFirst + 2);
        REQUIRE(session.refinement().added > 0);
        session.apply(edit);
        CHECK((session.refinement() == Refinement{}));
        render_passes(session, kFirst + 1);
        check_same(fresh, session);
    }
    // A camera that moves keeps it, as it keeps what was learned.
    fresh.apply(EditCamera{door().camera});
    CHECK(fresh.refinement().added > 0);
}

TEST_CASE("Another back end goes on with the refined placement") {
    Session whole = make_session(door(), refining(), 2);
    Session moved = make_session(door(), refining(), 2);
    render_passes(whole, kFirst + 1);
    render_passes(moved, kFirst + 1);
    moved.apply(EditBackend{make_cpu_backend({.threads = 1})});
    whole.apply(EditRestart{});
    render_passes(whole, 10);
    render_passes(moved, 10);
    check_same(whole, moved);
}

TEST_CASE("A back end that fails while the placement is refined leaves a session that begins anew") {
    using Failure = FailingBackend::Failure;
    Session fresh = make_session(door(), refining(), 2);
    render_passes(fresh, kFirst + 1);
    for (const Failure failure : {Failure::Volumes, Failure::Tables}) {
        const auto lost = std::make_shared<FailingBackend>();
        Session session(lost, std::make_shared<const SceneDescription>(door()), refining());
        render_passes(session, kFirst - 1);
        lost->failure = failure;
        CHECK_THAT(error_message(ErrorKind::Unavailable, [&] { session.advance(); }), contains("gone"));
        CHECK(session.passes() == 0);
        CHECK((session.refinement() == Refinement{}));
        session.apply(EditBackend{.backend = make_cpu_backend({.threads = 2}), .forget_old = true});
        render_passes(session, kFirst + 1);
        check_same(fresh, session);
    }
}

TEST_CASE("A radiance map that is complete and its picture go on, one that is not begins anew") {
    const RenderSettings settings = refining(1.0f);
    Session session = make_session(door(), settings, 2);
    session.apply(EditMethod{MethodId::Precomputed});
    render_passes(session, 2);
    const State before = state_of(session);
    const std::uint64_t records = session.field_status()->records;
    session.apply(EditMethod{MethodId::Reinforcement});
    render_passes(session, kFirst);
    const std::uint32_t added = session.refinement().added;
    REQUIRE(added > 0);
    session.apply(EditMethod{MethodId::Precomputed});
    CHECK(same_film(before, state_of(session)));
    CHECK(session.field_status()->records == records);
    CHECK(known_records(session) == records);
    CHECK(session.field_status()->precomputed_share == 1.0);
    CHECK(session.advance() == Progress::Rendered);
    CHECK(session.export_field().tables.mean_radiance.size() == before.tables.mean_radiance.size() + added);

    Session partial = make_session(door(), settings, 2);
    partial.apply(EditMethod{MethodId::Precomputed});
    REQUIRE(partial.advance() == Progress::Precomputed);
    const double spent = partial.clocks().precompute;
    partial.apply(EditMethod{MethodId::Reinforcement});
    render_passes(partial, kFirst);
    partial.apply(EditMethod{MethodId::Precomputed});
    CHECK(partial.field_status()->precomputed_share == 0.0);
    CHECK(partial.field_status()->records == 0);
    CHECK(partial.clocks().precompute == spent);  // what it took was taken
    render_passes(partial, 1);
    CHECK(known_records(partial) == partial.field_status()->records);
    const int volumes = partial.field_status()->volumes;
    CHECK(partial.field_status()->records ==
          static_cast<std::uint64_t>(volumes * settings.field.bins * settings.field.precompute_samples));
}

TEST_CASE("Views and inspection show the refined placement, its time is charged to learning") {
    Session session = make_session(door(), refining(1.0f), 2);
    session.apply(EditView{View::Voronoi});
    render_passes(session, 2);
    const std::vector<Vec3f> before = session.snapshot().pixels;
    session.apply(EditView{View::Beauty});
    render_passes(session, kFirst - 1);
    session.apply(EditView{View::Voronoi});
    CHECK(session.passes() == 2);  // nothing was added yet
    session.apply(EditView{View::Beauty});
    const double learn = session.clocks().learn;
    const double place = session.clocks().place;
    render_passes(session, 1);
    CHECK(session.passes() == kFirst);
    CHECK(session.clocks().learn > learn);
    CHECK(session.clocks().place == place);

    session.apply(EditView{View::Voronoi});
    CHECK(session.passes() == 0);
    render_passes(session, 2);
    CHECK_FALSE(same_bits(before, session.snapshot().pixels));
    const int volumes = session.field_status()->volumes;
    const HostVolumes placed = *session.export_field().volumes;
    const auto last = static_cast<std::size_t>(volumes - 1);
    const VolumeInspection inspection = session.inspect_volume(volumes - 1);
    CHECK(inspection.position == placed.sites[last].position);
    CHECK(session.find_volume_at(inspection.position, inspection.normal) == volumes - 1);
}

// What is published after kFirst passes decides where volumes are added: powers of two must not change a bit of it.
TEST_CASE("Refined scenes have the same bits 1024 times as large and as small") {
    Session expected = make_session(door(), refining(1.0f), 2);
    render_passes(expected, kLast + 1);
    REQUIRE(expected.refinement().added > 0);
    for (const float scale : {0x1p-10f, 0x1p10f}) {
        SceneDescription scene = door();
        for (Vec3f& position : scene.positions) position *= scale;
        RenderSettings settings = refining(1.0f);
        settings.camera.eye *= scale;
        settings.camera.target *= scale;
        Session other = make_session(scene, settings, 2);
        render_passes(other, kLast + 1);
        CHECK((other.refinement() == expected.refinement()));
        CHECK(same_film(state_of(expected), state_of(other)));
        CHECK(same_bits(state_of(expected).tables.visits, state_of(other).tables.visits));
    }
}
