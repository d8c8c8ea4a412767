// A material changed while a session runs: the session continues like a new one of the changed scene, and keeps the
// parts that do not depend on materials.
#include <algorithm>
#include <cmath>
#include <functional>

#include "core/scene/pack_scene.h"
#include "core/scene/scene_hash.h"
#include "tests/core/session/failing_backend.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/input_error.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

namespace {

std::uint32_t index_of(const SceneDescription& scene, const std::string& name) {
    for (std::uint32_t i = 0; i < scene.materials.size(); ++i)
        if (scene.materials[i].name == name) return i;
    FAIL("no material " << name);
    return 0;
}

/// A scene, and a material in it with its replacement.
struct Change {
    std::string text;
    SceneDescription before;
    EditMaterial edit{};
    bool keeps_volumes = false;

    SceneDescription after() const {
        SceneDescription scene = before;
        scene.materials[edit.index] = edit.material;
        return scene;
    }
};

template <class Do>
Change make_change(const std::string& scene, const std::string& material, bool keeps_volumes, Do&& change) {
    Change result{.text = scene + ": " + material, .before = shipped_scene(scene), .keeps_volumes = keeps_volumes};
    result.edit.index = index_of(result.before, material);
    result.edit.material = result.before.materials[result.edit.index];
    change(result.edit.material);
    return result;
}

std::vector<Change> all_changes() {
    using M = MaterialDescription;
    return {
        make_change("cornell", "red", true,
                    [](M& m) {
                        m.albedo = {0.1f, 0.2f, 0.7f};
                    }),
        make_change("cornell", "red", false, [](M& m) { m.albedo = glm::vec3{0.0f}; }),
        make_change("cornell", "light", true, [](M& m) { m.emission *= 8.0f; }),
        make_change("cornell", "light", false, [](M& m) { m.two_sided_emission = true; }),
        make_change("cornell", "red", false, [](M& m) { m.emission = glm::vec3{0.5f}; }),
        make_change("cornell", "white", false,
                    [](M& m) {
                        m.kind = SurfaceKind::Plastic;
                        m.roughness = 0.3f;
                    }),
        make_change("cornell", "white", false,
                    [](M& m) {
                        m.kind = SurfaceKind::Conductor;
                        m.specular = {0.9f, 0.7f, 0.4f};
                    }),
        make_change("spheres", "glass", false, [](M& m) { m.ior = 1.2f; }),
        make_change("spheres", "glass", false, [](M& m) { m.kind = SurfaceKind::Diffuse; }),
        make_change("cornell", "white", false,
                    [](M& m) {
                        m.opacity = 0.5f;
                        m.opacity_rule = OpacityRule::Blend;
                    }),
        make_change("textured-room", "lattice", false, [](M& m) { m.opacity_rule = OpacityRule::Blend; }),
        make_change("spheres", "mirror", false, [](M& m) { m.blend = {.other = 0, .share = 0.4f}; }),
        make_change("two-lights", "white", true, [](M& m) { m.albedo *= 0.5f; }),
    };
}

void check_like_fresh(Session& session, const SceneDescription& scene) {
    for (const MethodInfo& method : all_methods()) {
        INFO(method.name);
        RenderSettings settings = tiny_settings(scene, true);
        settings.method = method.id;
        Session fresh = make_session(scene, settings, 2);
        render_passes(fresh, kUsedPasses);
        const FilmSlot slot = slot_of(settings);
        render_passes(session, slot, kUsedPasses);
        CHECK(same_state(state_of(fresh), state_of(session, slot)));
        CHECK(fresh.served_kernel(slot).name == session.served_kernel(slot).name);
    }
}

bool same_scene(const HostScene& a, HostScene b) {
    bool same = true;
    zip(a, b, [&](const auto& x, const auto& y) { same = same && same_bits(x, y); });
    return same && a.light_power == b.light_power && a.environment == b.environment &&
           a.far_probability == b.far_probability && a.delta_probability == b.delta_probability;
}

}  // namespace

TEST_CASE("Material edit: the session goes on like a new one of the changed scene") {
    for (const Change& change : all_changes()) {
        INFO(change.text);
        Session session = used_session(change.before, tiny_settings(change.before, true));
        const double placed = session.clocks(kLearningFilm).place;
        CHECK(session.scene_hash() == scene_hash(change.before));
        session.apply(change.edit);
        CHECK(session.passes(kLearningFilm) == 0);
        CHECK(session.scene_hash() == scene_hash(change.after()));
        CHECK(session.scene_hash() != scene_hash(change.before));
        CHECK((session.clocks(kLearningFilm).place == placed) == change.keeps_volumes);
        check_like_fresh(session, change.after());
    }
}

TEST_CASE("Material edit: changed back, the session is like a new one of the first scene") {
    for (const Change& change : all_changes()) {
        INFO(change.text);
        Session session = used_session(change.before, tiny_settings(change.before, true));
        session.apply(change.edit);
        session.apply(EditMaterial{change.edit.index, change.before.materials[change.edit.index]});
        CHECK(scene_hash(session.scene()) == scene_hash(change.before));
        check_like_fresh(session, change.before);
    }
}

TEST_CASE("Material edit: repacking gives the bits of packing anew") {
    for (const Change& change : all_changes()) {
        INFO(change.text);
        const HostScene packed = pack_scene(change.before);
        const HostScene repacked = repack_materials(change.after(), packed);
        CHECK(same_scene(pack_scene(change.after()), repacked));
        CHECK(same_triangles(packed, repacked));
    }
    const SceneDescription textured = shipped_scene("textured-room");
    CHECK(same_scene(pack_scene(textured), repack_materials(textured, pack_scene(textured))));
    CHECK_FALSE(same_triangles(pack_scene(shipped_scene("door")), pack_scene(shipped_scene("cornell"))));
}

TEST_CASE("Material edit: the needed effects follow") {
    const Change change = make_change("cornell", "white", false, [](MaterialDescription& m) {
        m.kind = SurfaceKind::Plastic;
        m.roughness = 0.3f;
    });
    Session session = make_session(change.before, tiny_settings(change.before, true), 2);
    CHECK_FALSE(session.needed_features(slot_of(session)).has_any(kLobeFeatures));
    session.apply(change.edit);
    CHECK(session.needed_features(slot_of(session)).covers(features(Feature::Plastic, Feature::Rough)));
    session.apply(EditMaterial{change.edit.index, change.before.materials[change.edit.index]});
    CHECK_FALSE(session.needed_features(slot_of(session)).has_any(kLobeFeatures));
}

TEST_CASE("Material edit: a bad value is refused with the reason, and nothing changes") {
    const SceneDescription scene = shipped_scene("cornell");
    Session session = used_session(scene, tiny_settings(scene, true));
    const State before = state_of(session, kLearningFilm);
    const auto packed = session.packed_scene();
    const auto refused = [&](const std::string& part, const std::function<void(MaterialDescription&)>& spoil) {
        EditMaterial edit{0, scene.materials[0]};
        spoil(edit.material);
        const std::string message = error_message(ErrorKind::Input, [&] { session.apply(edit); });
        INFO(message);
        CHECK(message.find(part) != std::string::npos);
        CHECK(message.find(scene.materials[0].name) != std::string::npos);
    };
    refused("albedo", [](auto& m) { m.albedo.x = 1.5f; });
    refused("albedo", [](auto& m) { m.albedo.y = NAN; });
    refused("emission", [](auto& m) { m.emission.z = -1.0f; });
    refused("emission", [](auto& m) { m.emission.z = INFINITY; });
    refused("roughness", [](auto& m) { m.roughness = 1.01f; });
    refused("anisotropy", [](auto& m) { m.anisotropy = -0.1f; });
    refused("index of refraction", [](auto& m) { m.ior = 0.5f; });
    refused("specular", [](auto& m) { m.specular.x = -0.1f; });
    refused("transmission", [](auto& m) { m.transmission.x = 2.0f; });
    refused("no texture 7", [](auto& m) { m.textures.albedo = 7; });
    refused("a circle", [](auto& m) { m.blend = {.other = 0}; });
    refused("got number 99", [](auto& m) { m.blend = {.other = 99}; });
    const auto last = static_cast<std::uint32_t>(scene.materials.size());
    error_message(ErrorKind::Usage, [&] { session.apply(EditMaterial{last, scene.materials[0]}); });
    CHECK(session.packed_scene() == packed);
    CHECK(same_state(before, state_of(session, kLearningFilm)));
}

TEST_CASE("Material edit: a parked back end gets the changed scene when it returns") {
    const Change change = all_changes().front();
    const auto first = make_cpu_backend({.threads = 2});
    const std::shared_ptr<RenderBackend> kept = std::shared_ptr<RenderBackend>(make_cpu_backend({.threads = 1}));
    Session session = used_session(change.before, tiny_settings(change.before, true), kept);
    session.apply(EditBackend{std::shared_ptr<RenderBackend>(make_cpu_backend({.threads = 2}))});
    session.apply(change.edit);
    session.apply(EditBackend{kept});
    CHECK(session.passes(kLearningFilm) == 0);
    check_like_fresh(session, change.after());
}

TEST_CASE("Material edit: one that does not fit into the back end changes nothing") {
    const Change change = all_changes().front();
    const auto backend = std::make_shared<FailingBackend>();
    Session session = used_session(change.before, tiny_settings(change.before, true), backend);
    const State before = state_of(session, kLearningFilm);
    const auto packed = session.packed_scene();
    backend->failure = FailingBackend::Failure::Scene;
    error_message(ErrorKind::Unavailable, [&] { session.apply(change.edit); });
    CHECK(session.packed_scene() == packed);
    CHECK(scene_hash(session.scene()) == scene_hash(change.before));
    CHECK(same_state(before, state_of(session, kLearningFilm)));
    backend->failure = FailingBackend::Failure::None;
    session.apply(change.edit);
    check_like_fresh(session, change.after());
}
