// Learned fields moved from one session to another, also through a file: the session continues as if the field had
// never been moved. And the views of a field.
#include <algorithm>
#include <numeric>

#include "core/session/shown_range.h"
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

std::vector<Estimator> learning_estimators() {
    std::vector<Estimator> result;
    for (const Estimator& estimator : kEstimators)
        if (info_of(estimator.method).uses_field) result.push_back(estimator);
    return result;
}

bool same_field_status(const Session& a, const Session& b) {
    const std::optional<FieldStatus> x = a.field_status(a.settings().method);
    const std::optional<FieldStatus> y = b.field_status(b.settings().method);
    return x && y && x->volumes == y->volumes && x->bins == y->bins && x->passes == y->passes &&
           x->records == y->records && x->clamped_records == y->clamped_records &&
           x->lookup_misses == y->lookup_misses && x->precomputed_share == y->precomputed_share;
}

}  // namespace

TEST_CASE("A field that moved to another session goes on with the same bits") {
    const SceneDescription scene = shipped_scene("door");
    for (const Estimator estimator : learning_estimators()) {
        INFO(estimator);
        const RenderSettings settings = small_settings(scene, estimator);
        Session first = make_session(scene, settings, 2);
        render_passes(first, 3);
        const LearnedField field = first.export_field(first.settings().method);
        // The other session has rendered with a field of its own, of another size.
        RenderSettings other = settings;
        other.field = {};
        other.field.volumes = 20;
        other.field.bins = 16;
        Session second = make_session(scene, other, 1);
        render_passes(second, 1);

        first.apply(EditRestart{});
        second.import_field(through_file(field));
        CHECK((second.settings().field == settings.field));
        CHECK(second.passes(slot_of(second)) == 0);
        CHECK(same_field_status(first, second));
        for (int pass = 0; pass < 2; ++pass) {
            render_passes(first, 1);
            render_passes(second, 1);
            CHECK(same_state(state_of(first), state_of(second)));
            CHECK(same_field_status(first, second));
        }
    }
}

// The moments of the stops are not reproducible; the result must not depend on them.
TEST_CASE("A radiance map that moves in the middle of a slice is completed with the same bits") {
    const SceneDescription scene = shipped_scene("door");
    const RenderSettings settings = small_settings(scene, {MethodId::Precomputed, false});
    Session whole = make_session(scene, settings, 2);
    render_passes(whole, 2);
    const CpuSettings cpu{.threads = 2, .batch_paths = 32};
    const auto shared_scene = std::make_shared<const SceneDescription>(scene);
    Uniforms random(1);
    int moved = 0;
    for (int run = 0; run < 5000 && moved < 5; ++run) {
        auto session = std::make_unique<Session>(make_cpu_backend(cpu), shared_scene, settings);
        while (session->passes(slot_of(*session)) == 0) {
            advance_interrupted(*session, random.next());
            if (!slice_is_partial(*session)) continue;
            ++moved;
            const LearnedField field = session->export_field(session->settings().method);
            CHECK(field.progress.next_probe > 0);
            session = std::make_unique<Session>(make_cpu_backend(cpu), shared_scene, settings);
            session->import_field(through_file(field));
        }
        session->apply(EditRestart{});
        render_passes(*session, 2);
        CHECK(same_state(state_of(whole), state_of(*session)));
        CHECK(same_field_status(whole, *session));
    }
    CHECK(moved >= 5);
}

TEST_CASE("An imported field empties all pictures and the tables of other methods") {
    const SceneDescription scene = shipped_scene("door");
    RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, false});
    Session session = make_session(scene, settings, 2);
    render_passes(session, 2);
    const LearnedField field = session.export_field(session.settings().method);
    render_passes(session, {MethodId::Precomputed, View::Beauty}, 1);
    render_passes(session, {MethodId::Default, View::Beauty}, 1);

    session.apply(EditLearned{std::make_shared<const LearnedField>(field)});
    for (const MethodInfo& method : all_methods()) {
        CHECK(session.passes({method.id, View::Beauty}) == 0);
        const bool is_owner = method.id == MethodId::Reinforcement;
        CHECK(session.backend_access().has_field(method.id) == is_owner);
        if (is_owner)
            CHECK(same_bits(tables_of(session.backend_access().download_field(method.id)), tables_of(field.field)));
    }
    // The others start as in a new session.
    settings.method = MethodId::Precomputed;
    render_passes(session, slot_of(settings), 1);
    Session fresh = make_session(scene, settings, 2);
    render_passes(fresh, 1);
    CHECK(same_state(state_of(fresh), state_of(session, slot_of(settings))));
}

TEST_CASE("A field that does not belong to the session is refused and changes nothing") {
    const SceneDescription scene = shipped_scene("door");
    const RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, false});
    Session session = make_session(scene, settings, 2);
    CHECK_THAT(error_message(ErrorKind::Usage, [&] { session.export_field(session.settings().method); }),
               contains("'reinforcement' has learned nothing"));
    render_passes(session, 2);
    const State before = state_of(session);
    const LearnedField good = session.export_field(session.settings().method);

    LearnedField other_scene = good;
    other_scene.scene_hash = "0000000000000000";
    LearnedField short_table = good;
    tables_of(short_table.field).visits.pop_back();
    LearnedField default_method = good;
    default_method.method = MethodId::Default;
    LearnedField no_volumes = good;
    no_volumes.volumes.reset();
    LearnedField other_clusters = good;  // its arrays agree with its shape, but not with the scene's light tree
    other_clusters.shape.light_clusters = 2;
    other_clusters.field = make_field(other_clusters.shape, good.volumes->normals.size(), Representation::Table);
    CHECK_THAT(input_error([&] { session.import_field(other_scene); }),
               contains("another scene: expected scene hash " + good.scene_hash + ", got 0000000000000000"));
    for (const LearnedField& field : {short_table, default_method, no_volumes, other_clusters})
        CHECK_THAT(input_error([&] { session.import_field(field); }), contains("do not fit together"));
    CHECK(same_state(before, state_of(session)));
    CHECK((session.settings().field == settings.field));
    render_passes(session, 1);
    Session undisturbed = make_session(scene, settings, 2);
    render_passes(undisturbed, 3);
    CHECK(same_state(state_of(undisturbed), state_of(session)));

    CHECK_THAT(error_message(ErrorKind::Usage, [&] { session.export_field(MethodId::Default); }),
               contains("'default'"));
}

// With a BSDF fraction of 1 no direction comes from the tables, and no roulette uses them in paths of two vertices:
// only the random numbers matter. Paths that draw the same numbers as the training samples of the tables would be too
// dark by a fifth in the first pass (cornell, 60 volumes), since their directions have too large a density.
TEST_CASE("A picture that starts over with a learned field draws new random numbers") {
    const SceneDescription scene = shipped_scene("door");
    RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, false});
    settings.mixture = {.learned = 0, .bsdf_fraction = 1.0f};
    settings.max_depth = 2;
    Session session = make_session(scene, settings, 2);
    render_passes(session, 1);
    const std::vector<Vec3f> first = session.snapshot(slot_of(session)).pixels;
    const LearnedField field = session.export_field(session.settings().method);

    session.apply(EditRestart{});
    render_passes(session, 1);
    CHECK_FALSE(same_bits(first, session.snapshot(slot_of(session)).pixels));
    Session other = make_session(scene, settings, 2);
    other.import_field(field);
    render_passes(other, 1);
    CHECK_FALSE(same_bits(first, other.snapshot(slot_of(other)).pixels));

    // With empty tables it may draw the same numbers, like a new session.
    session.apply(EditForget{});
    render_passes(session, 1);
    CHECK(same_bits(first, session.snapshot(slot_of(session)).pixels));
}

TEST_CASE("Heat maps show values of the tables after the last pass") {
    const SceneDescription scene = shipped_scene("cornell");
    for (const MethodId method : {MethodId::Precomputed, MethodId::Reinforcement}) {
        RenderSettings settings = small_settings(scene, {method, false});
        settings.view = View::Visits;
        Session session = make_session(scene, settings, 2);
        render_passes(session, 3);
        const State state = state_of(session);
        std::vector<float> totals;
        for (std::size_t first = 0; first < state.tables.visits.size(); first += 64)
            totals.push_back(std::accumulate(state.tables.visits.begin() + static_cast<std::ptrdiff_t>(first),
                                             state.tables.visits.begin() + static_cast<std::ptrdiff_t>(first + 64),
                                             0.0f, [](float sum, std::uint32_t n) { return sum + float(n); }));
        std::size_t seen = 0;
        for (const Vec3f pixel : state.snapshot.pixels) {
            CHECK(pixel == Vec3f{pixel.x});
            if (pixel.x == 0.0f) continue;
            ++seen;
            CHECK(std::ranges::find(totals, pixel.x) != totals.end());
        }
        CHECK(seen > state.snapshot.pixels.size() / 2);
        CHECK(shown_range(state.snapshot).high <= *std::ranges::max_element(totals));
        CHECK(legend(state.snapshot).find("records") != std::string::npos);
    }
}

TEST_CASE("The range of entropy is that of the field's bins, also for a method without a field") {
    const SceneDescription scene = shipped_scene("cornell");
    for (const MethodInfo& method : all_methods()) {
        RenderSettings settings = small_settings(scene, {method.id, false});
        settings.view = View::Entropy;
        Session session = make_session(scene, settings, 2);
        render_passes(session, 1);
        const Snapshot snapshot = session.snapshot(slot_of(session));
        CHECK(legend(snapshot) == "0 to 6 bits");
        float least = 6.0f;
        for (const Vec3f pixel : snapshot.pixels) {
            REQUIRE((pixel.x >= 0.0f && pixel.x <= 6.00001f));
            if (pixel.x > 0.0f) least = std::min(least, pixel.x);
        }
        // Uniform without training samples.
        CHECK((least < 5.9f) == method.uses_field);
    }
}

TEST_CASE("Views tell the range of their values") {
    Snapshot snapshot;
    snapshot.bins = 256;
    const auto shown = [&](View view, const std::vector<float>& values) {
        snapshot.slot.view = view;
        snapshot.pixels.clear();
        for (const float value : values) snapshot.pixels.push_back(Vec3f{value});
        return legend(snapshot);
    };
    CHECK(shown(View::Beauty, {5.0f}).empty());
    CHECK(shown(View::Voronoi, {5.0f}).empty());
    CHECK(shown(View::Depth, {5.0f, kInfinity, kNan, 2.5f}) == "0 to 5");
    CHECK(shown(View::Visits, {5.0f, 70.0f}) == "0 to 70 records");
    CHECK(shown(View::Irradiance, {0.0f}) == "0 to 1 radiance x sr");
    CHECK(shown(View::Entropy, {5.0f}) == "0 to 8 bits");
    CHECK(shown(View::BsdfShare, {0.5f}) == "0 to 1 (share)");
    CHECK(shown(View::Change, {0.125f}) == "0 to 0.125 of the mean");
    CHECK(shown(View::Unvisited, {0.5f}) == "0 to 1 (share)");
    shown(View::Depth, {5.0f, 2.5f});
    CHECK(shown_range(snapshot).scale() == 0.2f);
    shown(View::Depth, {1e-45f});
    CHECK(shown_range(snapshot).scale() == 1.0f);
}
