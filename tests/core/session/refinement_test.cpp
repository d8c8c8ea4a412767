// Volumes divided while a method learns: the same ones in every run, also if it was interrupted, moved or saved. No
// training sample and no pass is lost.
#include <numeric>

#include "tests/core/session/failing_backend.h"
#include "tests/core/session/interruption.h"
#include "tests/core/session/through_file.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/input_error.h"
#include "tests/support/scenes/shapes.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

namespace {

/// Passes before the first round of refinement, and before the last.
constexpr std::uint32_t kFirst = 8;
constexpr std::uint32_t kLast = 16;

const SceneDescription& door() {
    static const SceneDescription scene = shipped_scene("door");
    return scene;
}

RenderSettings refining(float share = 0.5f, Estimator estimator = kLearningPaths) {
    RenderSettings settings = small_settings(door(), estimator);
    settings.field.refine_share = share;
    return settings;
}

std::uint64_t known_records(const Session& session, MethodId method = MethodId::Reinforcement) {
    const HostTables tables = tables_of(session.export_field(method).field);
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
    CHECK(same_sites(*a.export_field(a.settings().method).volumes, *b.export_field(b.settings().method).volumes));
}

}  // namespace

TEST_CASE("Volumes are added after 8 and after 16 passes, up to their share, and no training sample is lost") {
    for (const float share : {0.1f, 0.5f, 1.0f}) {
        Session session = make_session(door(), refining(share), 2);
        render_passes(session, 1);
        const int placed = session.field_status(session.settings().method)->volumes;
        const int most = static_cast<int>(share * static_cast<float>(placed));
        for (std::uint32_t pass = 1; pass <= 20; ++pass) {
            INFO("share " << share << ", after pass " << pass);
            const FieldStatus status = *session.field_status(session.settings().method);
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
    CHECK(same_film(state_of(off), state_of(on)));  // the pass is rendered before the refinement
    CHECK_FALSE(same_bits(state_of(off).tables, state_of(on).tables));
    render_passes(off, kLast);
    CHECK((off.refinement() == Refinement{}));
    // The budget suffices for the placed volumes only.
    RenderSettings settings = refining(1.0f);
    settings.field.volumes = 0;
    settings.field.budget_megabytes = 60.5 * static_cast<double>(bytes_per_volume(settings.field.bins)) / 1e6;
    Session full = make_session(door(), settings, 2);
    render_passes(full, kLast);
    CHECK(full.field_status(full.settings().method)->added_volumes == 0);
    CHECK(full.field_status(full.settings().method)->bytes <=
          static_cast<std::size_t>(1e6 * settings.field.budget_megabytes));
}

TEST_CASE(
    "Without a given share volumes are added where the budget decides, as many as the training samples suffice for") {
    constexpr std::uint64_t kRecordsPerVolume = 32 * 4;
    RenderSettings settings = settings_for(door(), kLearningPaths, 61, 47);
    settings.field.bins = 4;
    Session session = make_session(door(), settings, 2);
    render_passes(session, kFirst - 1);
    const auto placed = static_cast<std::uint64_t>(session.field_status(session.settings().method)->volumes);
    CHECK(session.field_status(session.settings().method)->added_volumes == 0);
    render_passes(session, 1);
    const FieldStatus few = *session.field_status(session.settings().method);
    REQUIRE(few.records / kRecordsPerVolume > placed);
    REQUIRE(few.records / kRecordsPerVolume < placed + placed / 2);
    CHECK(static_cast<std::uint64_t>(few.volumes) <= few.records / kRecordsPerVolume);
    CHECK(static_cast<std::uint64_t>(few.volumes) >= few.records / kRecordsPerVolume - 2);
    render_passes(session, kLast - kFirst);
    const FieldStatus enough = *session.field_status(session.settings().method);
    REQUIRE(enough.records / kRecordsPerVolume > 2 * placed);
    CHECK(static_cast<std::uint64_t>(enough.volumes) <= 2 * placed);
    CHECK(static_cast<std::uint64_t>(enough.volumes) >= 2 * placed - 20);
}

TEST_CASE("Without a given share no volume is added in small pictures, nor where the number of volumes is given") {
    RenderSettings settings = settings_for(door(), kLearningPaths, 30, 20);
    settings.field.bins = 4;
    Session small = make_session(door(), settings, 2);
    render_passes(small, kLast);
    CHECK((small.refinement() == Refinement{.rounds = 2}));
    Session numbered = make_session(door(), refining(kRefineByRecords), 2);
    Session off = make_session(door(), refining(0.0f), 2);
    render_passes(numbered, kLast + 1);
    render_passes(off, kLast + 1);
    CHECK(numbered.field_status(numbered.settings().method)->records > 60 * 64 * 32);
    CHECK(same_state(state_of(off), state_of(numbered)));
}

TEST_CASE("Without a given share volumes are also added later, as training samples come") {
    constexpr std::uint64_t kRecordsPerVolume = 96 * 4;
    constexpr std::uint32_t kRounds = 4;  // after 8, 16, 48 and 96 passes
    RenderSettings settings = settings_for(door(), kLearningPaths, 26, 20);
    settings.field.bins = 4;
    Session session = make_session(door(), settings, 2);
    render_passes(session, 191);
    CHECK((session.refinement() == Refinement{.rounds = kRounds}));
    render_passes(session, 1);
    const FieldStatus after = *session.field_status(session.settings().method);
    INFO(after.records << " records, " << after.volumes << " volumes, of which " << after.added_volumes
                       << " were added");
    CHECK(after.added_volumes > 0);
    CHECK(after.added_volumes < after.volumes / 2);
    CHECK(static_cast<std::uint64_t>(after.volumes) <= after.records / kRecordsPerVolume);
    CHECK(session.refinement().rounds == kRounds + 1);
}

TEST_CASE("A given share is added in two rounds") {
    Session session = make_session(door(), refining(), 2);
    render_passes(session, kLast);
    const Refinement added = session.refinement();
    CHECK(added.rounds == 2);
    render_passes(session, 3 * kLast);
    CHECK((session.refinement() == added));
}

TEST_CASE("Neither threads nor interruptions change a bit of a refinement") {
    Session expected = make_session(door(), refining(), 1);
    render_passes(expected, kLast + 2);
    REQUIRE(expected.refinement().rounds == 2);
    for (const int threads : {2, 7}) {
        Session other = make_session(door(), refining(), threads);
        render_passes(other, kLast + 2);
        check_same(expected, other);
    }
    Uniforms random(2);
    Session interrupted(make_cpu_backend({.threads = 2, .batch_paths = 32}),
                        std::make_shared<const SceneDescription>(door()), refining());
    int partial = 0;
    while (interrupted.passes(slot_of(interrupted)) < kLast + 2) {
        if (interrupted.passes(slot_of(interrupted)) + 1 < kLast + 2)
            advance_interrupted(interrupted, random.next());
        else
            interrupted.advance(slot_of(interrupted));
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
        const LearnedField field = through_file(first.export_field(first.settings().method));
        CHECK((field.refinement == first.refinement()));
        Session second = make_session(door(), small_settings(door(), kLearningPaths), 1);
        second.import_field(field);
        CHECK(second.field_status(second.settings().method)->added_volumes ==
              first.field_status(first.settings().method)->added_volumes);
        first.apply(EditRestart{});
        render_passes(first, 12);
        render_passes(second, 12);
        check_same(first, second);
        CHECK(first.refinement().rounds == 2);
    }
}

TEST_CASE("Clearing the tables brings back the first placement") {
    const std::vector<SessionEdit> edits{
        EditForget{}, EditEstimator{.max_depth = 64, .next_event = false, .guiding = GuidingRule::Always},
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
    // A moved camera keeps the refinement, as it keeps the field.
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
        CHECK_THAT(error_message(ErrorKind::Unavailable, [&] { session.advance(slot_of(session)); }),
                   contains("gone"));
        CHECK(session.passes(slot_of(session)) == 0);
        CHECK((session.refinement() == Refinement{}));
        session.apply(EditBackend{.backend = make_cpu_backend({.threads = 2}), .forget_old = true});
        render_passes(session, kFirst + 1);
        check_same(fresh, session);
    }
}

TEST_CASE("A radiance map that is complete and its picture go on, one that is not begins anew") {
    constexpr FilmSlot kMap{MethodId::Precomputed, View::Beauty};
    const RenderSettings settings = refining(1.0f);
    Session session = make_session(door(), settings, 2);
    const auto map = [&] { return *session.field_status(kMap.method); };
    render_passes(session, kMap, 2);
    const State before = state_of(session, kMap);
    const std::uint64_t records = map().records;
    render_passes(session, kLearningFilm, kFirst);
    const std::uint32_t added = session.refinement().added;
    REQUIRE(added > 0);
    CHECK(same_film(before, state_of(session, kMap)));
    CHECK(map().records == records);
    CHECK(known_records(session, kMap.method) == records);
    CHECK(map().precomputed_share == 1.0);
    CHECK(session.advance(kMap) == Progress::Rendered);
    CHECK(tables_of(session.export_field(kMap.method).field).mean_radiance.size() ==
          before.tables.mean_radiance.size() + added);

    Session partial = make_session(door(), settings, 2);
    const auto partial_map = [&] { return *partial.field_status(kMap.method); };
    REQUIRE(partial.advance(kMap) == Progress::Precomputed);
    const double spent = partial.clocks(kMap).precompute;
    render_passes(partial, kLearningFilm, kFirst);
    CHECK(partial_map().precomputed_share == 0.0);
    CHECK(partial_map().records == 0);
    CHECK(partial.clocks(kMap).precompute == spent);  // the seconds stay charged
    render_passes(partial, kMap, 1);
    CHECK(known_records(partial, kMap.method) == partial_map().records);
    CHECK(partial_map().records == static_cast<std::uint64_t>(partial_map().volumes * settings.field.bins *
                                                              settings.field.precompute_samples));
}

TEST_CASE("Views and inspection show the refined placement, its time is charged to learning") {
    const RenderSettings settings = refining(1.0f);
    const FilmSlot picture = slot_of(settings);
    const FilmSlot cells{picture.method, View::Voronoi};
    Session session = make_session(door(), settings, 2);
    render_passes(session, cells, 2);
    const std::vector<Vec3f> before = session.snapshot(cells).pixels;
    render_passes(session, picture, kFirst - 1);
    CHECK(session.passes(cells) == 2);  // no volume is added yet
    const Clocks clocks = session.clocks(picture);
    render_passes(session, picture, 1);
    CHECK(session.passes(picture) == kFirst);
    CHECK(session.clocks(picture).learn > clocks.learn);
    CHECK(session.clocks(picture).place == clocks.place);

    CHECK(session.passes(cells) == 0);
    render_passes(session, cells, 2);
    CHECK_FALSE(same_bits(before, session.snapshot(cells).pixels));
    const int volumes = session.field_status(picture.method)->volumes;
    const HostVolumes placed = *session.export_field(picture.method).volumes;
    const auto last = static_cast<std::size_t>(volumes - 1);
    const VolumeInspection inspection = session.inspect_volume(picture.method, volumes - 1);
    CHECK(inspection.position == placed.sites[last].position);
    CHECK(session.find_volume_at(inspection.position, inspection.normal) == volumes - 1);
}

// The tables after kFirst passes decide the added volumes: scaling by powers of two must not change a bit of them.
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
