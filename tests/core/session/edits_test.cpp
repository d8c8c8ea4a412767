// The films, tables, volumes and scene that each edit clears, and no more: the table of core/session/edits.h, at least one
// case for every alternative of SessionEdit, on real sessions in which all methods have rendered and learned.
#include <algorithm>
#include <set>

#include "tests/support/catch.hpp"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

namespace {

/// All parts that an edit may clear, as visible to a caller of the session.
struct Contents {
    std::array<State, kMethodCount> methods;
    std::shared_ptr<const HostScene> scene;
    double place_seconds = 0.0;  ///< measured anew by every placement
};

Contents contents_of(Session& session) {
    session.find_volume_at(Vec3f{0.0f}, Vec3f{0.0f, 1.0f, 0.0f});  // places volumes if there are none
    Contents contents{{}, session.packed_scene(), session.clocks({learning_method(), View::Beauty}).place};
    for (const MethodInfo& method : all_methods())
        contents.methods[static_cast<std::size_t>(method.id)] = state_of(session, {method.id, View::Beauty});
    return contents;
}

bool all_films_empty(const Contents& contents) {
    return std::ranges::all_of(contents.methods, [](const State& s) {
        return s.snapshot.passes == 0 && s.snapshot.counters.paths == 0 &&
               std::ranges::all_of(s.snapshot.pixels, [](const Vec3f& p) { return p == Vec3f{0.0f}; });
    });
}
bool all_films_kept(const Contents& before, const Contents& after) {
    return std::ranges::equal(before.methods, after.methods, [](const State& a, const State& b) {
        return same_film(a, b) && same_events(a.snapshot.counters, b.snapshot.counters);
    });
}
bool all_tables_empty(const Contents& contents) {
    return std::ranges::all_of(contents.methods, [](const State& s) {
        return std::ranges::all_of(s.tables.visits, [](std::uint32_t n) { return n == 0; });
    });
}
bool all_tables_kept(const Contents& before, const Contents& after) {
    return std::ranges::equal(before.methods, after.methods,
                              [](const State& a, const State& b) { return same_bits(a.tables, b.tables); });
}

/// The method of a learned field has the tables of the field, and the other methods have no training samples.
bool only_has(const Contents& contents, const LearnedField& field) {
    return std::ranges::all_of(all_methods(), [&](const MethodInfo& method) {
        const HostTables& tables = contents.methods[static_cast<std::size_t>(method.id)].tables;
        return method.id == field.method ? same_bits(tables, tables_of(field.field))
                                         : std::ranges::all_of(tables.visits, [](std::uint32_t n) { return n == 0; });
    });
}

/// A field of another size than `settings` give, learned by another session of the same scene.
std::shared_ptr<const LearnedField> field_from_elsewhere(const SceneDescription& scene, RenderSettings settings) {
    settings.method = MethodId::Reinforcement;
    settings.seed = 11;
    settings.field.volumes = 50;
    Session session = make_session(scene, settings, 2);
    render_passes(session, kUsedPasses);
    return std::make_shared<const LearnedField>(session.export_field(session.settings().method));
}

struct Case {
    std::string name;
    SessionEdit edit;
    Invalidation cleared;
};

/// `scene` is the scene of the session.
std::vector<Case> all_cases(const SceneDescription& scene, const RenderSettings& settings) {
    CameraDescription camera = settings.camera;
    camera.eye.x += 0.1f;
    FieldSettings field = settings.field;
    field.volumes = 50;
    SceneDescription brighter = shipped_scene("door");
    for (MaterialDescription& material : brighter.materials) material.emission *= 2.0f;
    MaterialDescription darker = scene.materials[0];
    darker.albedo *= 0.5f;
    return {
        {"camera", EditCamera{camera}, {.films = true}},
        {"size", EditSize{50, 20}, {.films = true}},
        {"seed", EditSeed{7}, {.films = true, .tables = true}},
        {"depth", EditEstimator{10, false}, {.films = true, .tables = true}},
        {"light samples", EditEstimator{64, true}, {.films = true, .tables = true}},
        {"roulette", EditEstimator{64, false, RouletteRule::Albedo}, {.films = true, .tables = true}},
        {"guiding",
         EditEstimator{64, false, RouletteRule::Spare, GuidingRule::Always},
         {.films = true, .tables = true}},
        {"mixture", EditMixture{{.learned = 0, .bsdf_fraction = 0.3f}}, {.films = true}},
        {"field", EditField{field}, {.films = true, .tables = true, .volumes = true}},
        {"scene",
         EditScene{std::make_shared<const SceneDescription>(brighter)},
         {.films = true, .tables = true, .volumes = true, .scene = true}},
        {"material", EditMaterial{0, darker}, {.films = true, .tables = true}},
        {"back end", EditBackend{make_cpu_backend({.threads = 1})}, {}},
        {"restart", EditRestart{}, {.films = true}},
        {"forget", EditForget{}, {.films = true, .tables = true}},
        {"learned field", EditLearned{field_from_elsewhere(scene, settings)}, {.films = true}},
        {"freeze", EditLearning{MethodId::Reinforcement, LearningControl::Freeze}, {}},
        {"step", EditLearning{MethodId::Reinforcement, LearningControl::Step}, {}},
        {"continue", EditLearning{MethodId::Reinforcement, LearningControl::Continue}, {}},
        {"one volume", EditForgetVolume{MethodId::Reinforcement, 3}, {}},
    };
}

/// The scene of a session after an edit.
SceneDescription edited(SceneDescription scene, const SessionEdit& edit) {
    if (const auto* replaced = std::get_if<EditScene>(&edit)) return *replaced->scene;
    if (const auto* changed = std::get_if<EditMaterial>(&edit)) scene.materials[changed->index] = changed->material;
    return scene;
}

/// The settings of a session after an edit, but for its method; settings of commands and scenes stay.
RenderSettings edited(RenderSettings settings, const SessionEdit& edit) {
    if (const auto* camera = std::get_if<EditCamera>(&edit)) settings.camera = camera->camera;
    if (const auto* size = std::get_if<EditSize>(&edit)) {
        settings.width = size->width;
        settings.height = size->height;
    }
    if (const auto* seed = std::get_if<EditSeed>(&edit)) settings.seed = seed->seed;
    if (const auto* estimator = std::get_if<EditEstimator>(&edit)) {
        settings.max_depth = estimator->max_depth;
        settings.next_event = estimator->next_event;
        settings.roulette = estimator->roulette;
        settings.guiding = estimator->guiding;
    }
    if (const auto* mixture = std::get_if<EditMixture>(&edit)) settings.mixture = mixture->mixture;
    if (const auto* field = std::get_if<EditField>(&edit)) settings.field = field->field;
    if (const auto* learned = std::get_if<EditLearned>(&edit)) settings.field = learned->field->settings;
    return settings;
}

}  // namespace

TEST_CASE("Every kind of edit has a case here") {
    const SceneDescription scene = shipped_scene("door");
    std::set<std::size_t> covered;
    for (const Case& c : all_cases(scene, tiny_settings(scene, false))) covered.insert(c.edit.index());
    for (std::size_t i = 0; i < std::variant_size_v<SessionEdit>; ++i) {
        INFO("alternative " << i << " of SessionEdit");
        CHECK(covered.contains(i));
    }
}

TEST_CASE("Every edit clears what the table says and keeps the rest") {
    const SceneDescription scene = shipped_scene("door");
    for (const Case& c : all_cases(scene, tiny_settings(scene, false))) {
        INFO(c.name);
        RenderSettings ignored;
        CHECK(take_over(c.edit, ignored) == c.cleared);
        const std::shared_ptr<RenderBackend> backend = make_cpu_backend({.threads = 2});
        Session session = used_session(scene, tiny_settings(scene, false), backend);
        const Contents before = contents_of(session);
        REQUIRE_FALSE(all_films_empty(before));
        REQUIRE_FALSE(all_tables_empty(before));

        session.apply(c.edit);
        session.apply(EditBackend{backend});  // films are parked with their back end
        const Contents after = contents_of(session);
        CHECK(all_films_empty(after) == c.cleared.films);
        CHECK(all_films_kept(before, after) == !c.cleared.films);
        CHECK(all_tables_empty(after) == c.cleared.tables);
        if (const auto* learned = std::get_if<EditLearned>(&c.edit)) {
            CHECK(only_has(after, *learned->field));
        } else if (!std::holds_alternative<EditForgetVolume>(c.edit)) {  // session_learning_test.cpp
            CHECK(all_tables_kept(before, after) == !c.cleared.tables);
        }
        CHECK((after.place_seconds == before.place_seconds) == !c.cleared.volumes);
        const bool repacked = c.cleared.scene || std::holds_alternative<EditMaterial>(c.edit);
        CHECK((after.scene == before.scene) == !repacked);
    }
}

TEST_CASE("An edit that clears the tables leaves a session like a new one") {
    const SceneDescription scene = shipped_scene("door");
    const RenderSettings settings = tiny_settings(scene, false);
    for (const Case& c : all_cases(scene, settings)) {
        if (!c.cleared.tables) continue;
        Session session = used_session(scene, settings);
        session.apply(c.edit);
        const SceneDescription new_scene = edited(scene, c.edit);
        for (const MethodInfo& method : all_methods()) {
            INFO(c.name << ", " << method.name);
            RenderSettings fresh_settings = edited(settings, c.edit);
            fresh_settings.method = method.id;
            Session fresh = make_session(new_scene, fresh_settings, 2);
            render_passes(fresh, kUsedPasses);
            const FilmSlot slot = slot_of(fresh_settings);
            render_passes(session, slot, kUsedPasses);
            CHECK(same_state(state_of(fresh), state_of(session, slot)));
        }
    }
}

// Default path tracing has no field, so clearing its film must suffice for the state of a new session.
TEST_CASE("An edit that clears the films leaves default path tracing like a new session") {
    const SceneDescription scene = shipped_scene("door");
    const RenderSettings settings = tiny_settings(scene, false);
    for (const Case& c : all_cases(scene, settings)) {
        if (!c.cleared.films || c.cleared.tables) continue;
        INFO(c.name);
        Session session = used_session(scene, settings);
        session.apply(c.edit);
        render_passes(session, kUsedPasses);
        Session fresh = make_session(scene, edited(settings, c.edit), 2);
        render_passes(fresh, kUsedPasses);
        CHECK(same_state(state_of(fresh), state_of(session)));
    }
}

// The tables kept for a moved camera guide the first pass of the new view.
TEST_CASE("A moved camera goes on with the learned field") {
    const SceneDescription scene = shipped_scene("door");
    RenderSettings settings = tiny_settings(scene, false);
    settings.method = MethodId::Reinforcement;
    Session session = make_session(scene, settings, 2);
    render_passes(session, 8);
    const std::uint64_t records = session.field_status(session.settings().method)->records;
    CameraDescription camera = settings.camera;
    camera.eye.x += 0.1f;
    session.apply(EditCamera{camera});
    CHECK(session.field_status(session.settings().method)->records == records);
    CHECK(session.field_status(session.settings().method)->passes == 8);
    render_passes(session, 1);
    CHECK(session.field_status(session.settings().method)->records > records);
    settings.camera = camera;
    Session fresh = make_session(scene, settings, 2);
    render_passes(fresh, 1);
    CHECK_FALSE(same_bits(fresh.snapshot(slot_of(fresh)).pixels, session.snapshot(slot_of(session)).pixels));
}

TEST_CASE("A pass that was stopped is forgotten with its film") {
    const SceneDescription scene = shipped_scene("door");
    Session session = make_session(scene, tiny_settings(scene, false), 2);
    render_passes(session, 1);
    StopFlag stop{true};
    REQUIRE(session.advance(slot_of(session), &stop) == Progress::Stopped);
    session.apply(EditRestart{});
    render_passes(session, 1);
    Session fresh = make_session(scene, tiny_settings(scene, false), 2);
    render_passes(fresh, 1);
    CHECK(same_state(state_of(fresh), state_of(session)));
}
