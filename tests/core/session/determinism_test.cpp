// Every bit is decided by scene, settings and seed: not by the number of threads, the size of batches, the moment at which a
// pass was stopped, other films in between, or the compiled superset of effects.
#include "core/kernel/shading/lambert.h"
#include "core/scene/needed_effects.h"
#include "core/scene/pack_scene.h"
#include "cpu/rays/batch_tracer.h"
#include "tests/core/session/interruption.h"
#include "tests/support/catch.hpp"
#include "tests/support/rays/brute_force.h"
#include "tests/support/scenes/image_scenes.h"
#include "tests/support/scenes/shapes.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"
#include "tests/support/session/variants.h"

using namespace pl;
using namespace pl::test;

namespace {

State render(const SceneDescription& scene, const RenderSettings& settings, const CpuSettings& cpu) {
    Session session(make_cpu_backend(cpu), std::make_shared<const SceneDescription>(scene), settings);
    render_passes(session, 4);
    return state_of(session);
}

/// Rays of diffuse paths from the camera.
std::vector<Ray> rays_of_paths(const SceneView& scene, const Camera& camera, std::size_t count) {
    const BvhIntersector intersector{scene};
    Uniforms random(6);
    std::vector<Ray> rays;
    while (rays.size() < count) {
        rays.push_back(generate_ray(camera, 64.0f * random.square(), {64.0f, 64.0f}));
        for (int vertex = 0; vertex < 8; ++vertex) {
            const Hit hit = intersector.closest_hit(rays.back());
            if (!hit.found()) break;
            const SurfacePoint point = make_surface_point<FeatureSet{}>(scene, hit, -rays.back().direction);
            rays.push_back(spawn_ray(point, lambert_sample(point, random.square())));
        }
    }
    return rays;
}

}  // namespace

TEST_CASE("Threads and batches do not change a bit of films, tables and counters") {
    const SceneDescription scene = shipped_scene("door");
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        const RenderSettings settings = small_settings(scene, estimator);
        const State one = render(scene, settings, {.threads = 1});
        CHECK(same_state(one, render(scene, settings, {.threads = 2})));
        CHECK(same_state(one, render(scene, settings, {.threads = 7})));
        CHECK(same_state(one, render(scene, settings, {.threads = 2, .batch_paths = 37})));
        CHECK(one.tables.radiance.empty() == !info_of(estimator.method).uses_field);
    }
}

TEST_CASE("Threads, batches and stops do not change a bit of a scene that needs every effect") {
    const SceneDescription scene = every_effect();
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        const RenderSettings settings = small_settings(scene, estimator);
        const State one = render(scene, settings, {.threads = 1});
        CHECK(one.snapshot.counters.invalid_samples == 0);
        CHECK(same_state(one, render(scene, settings, {.threads = 3, .batch_paths = 37})));
        Session stopped = make_session(scene, settings, 2);
        StopFlag stop = true;
        CHECK(stopped.advance(slot_of(stopped), &stop) == Progress::Stopped);
        render_passes(stopped, one.snapshot.passes);
        CHECK(same_state(one, state_of(stopped)));
    }
}

TEST_CASE(
    "Every target, learned light, rate and rule of roulette has the same bits for all threads, stopped or not") {
    const SceneDescription scene = shipped_scene("door");
    for (const Variant& variant : kVariants) {
        INFO(variant.name);
        const RenderSettings settings =
            variant.of(small_settings(scene, {MethodId::Reinforcement, variant.next_event}));
        const State expected = render(scene, settings, {.threads = 1});
        CHECK(same_state(expected, render(scene, settings, {.threads = 3, .batch_paths = 77})));
        CHECK_FALSE(same_bits(
            expected.tables,
            render(scene, small_settings(scene, {MethodId::Reinforcement, variant.next_event}), {.threads = 2})
                .tables));
        Session stopped = make_session(scene, settings, 2);
        StopFlag stop = true;
        CHECK(stopped.advance(slot_of(stopped), &stop) == Progress::Stopped);
        render_passes(stopped, expected.snapshot.passes);
        CHECK(same_state(expected, state_of(stopped)));
    }
}

TEST_CASE("Paths in every shipped scene meet the same hits by the wide hierarchy as by the two-wide one") {
    for (const std::string& name : list_scenes(PL_SOURCE_DIR "/assets")) {
        INFO(name);
        const SceneDescription description = shipped_scene(name);
        const HostScene packed = pack_scene(description);
        const std::vector<Ray> rays = rays_of_paths(packed.view(), make_camera(description.camera, 64, 64), 10000);
        const auto count = static_cast<std::uint32_t>(rays.size());
        RayBatch batch(count);
        for (std::uint32_t i = 0; i < count; ++i) batch.set_ray(i, rays[i]);
        const WideIntersector wide(packed.view());
        wide.find_closest(batch, count);
        wide.find_occluded(batch, count);
        for (std::uint32_t i = 0; i < count; ++i) {
            REQUIRE(same_bits(batch.hit(i), BvhIntersector{packed.view()}.closest_hit(rays[i])));
            REQUIRE(batch.occluded(i) == batch.hit(i).found());
        }
    }
}

TEST_CASE("A seed changes films and tables") {
    const SceneDescription scene = shipped_scene("door");
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        RenderSettings settings = small_settings(scene, estimator);
        const State one = render(scene, settings, {.threads = 2});
        settings.seed = 2;
        const State other = render(scene, settings, {.threads = 2});
        CHECK_FALSE(same_bits(one.snapshot.pixels, other.snapshot.pixels));
        if (info_of(estimator.method).uses_field) CHECK_FALSE(same_bits(one.tables.radiance, other.tables.radiance));
        // Seeds beyond 32 bits count too.
        settings.seed = 2 + (std::uint64_t{1} << 32);
        CHECK_FALSE(same_bits(other.snapshot.pixels, render(scene, settings, {.threads = 2}).snapshot.pixels));
    }
}

// Small batches, so that passes stop soon after the flag is raised. The moments of the stops are not reproducible,
// and the results must not depend on them; runs are repeated until some stops have left passes incomplete.
TEST_CASE("Work that is stopped and resumed at any moment does not change a bit") {
    const SceneDescription scene = shipped_scene("door");
    const CpuSettings cpu{.threads = 2, .batch_paths = 32};
    Uniforms random(1);
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        RenderSettings settings = small_settings(scene, estimator);
        settings.width = 128;
        const State uninterrupted = render(scene, settings, cpu);
        const int wanted_slices = estimator.method == MethodId::Precomputed ? 3 : 0;
        int partial_passes = 0;
        int partial_slices = 0;
        for (int run = 0; run < 5000 && (partial_passes < 3 || partial_slices < wanted_slices); ++run) {
            Session session(make_cpu_backend(cpu), std::make_shared<const SceneDescription>(scene), settings);
            while (session.passes(slot_of(session)) < 3) {
                advance_interrupted(session, random.next());
                partial_passes += pass_is_partial(session) ? 1 : 0;
                partial_slices += slice_is_partial(session) ? 1 : 0;
            }
            while (session.passes(slot_of(session)) < 4) session.advance(slot_of(session));
            CHECK(same_state(uninterrupted, state_of(session)));
        }
        CHECK(partial_passes >= 3);
        CHECK(partial_slices >= wanted_slices);
    }
}

TEST_CASE("A flag that is set from the beginning starts nothing and loses nothing") {
    const SceneDescription scene = shipped_scene("door");
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        const RenderSettings settings = small_settings(scene, estimator);
        Session session = make_session(scene, settings, 2);
        const StopFlag stop{true};
        for (int i = 0; i < 3; ++i) CHECK(session.advance(slot_of(session), &stop) == Progress::Stopped);
        CHECK(session.passes(slot_of(session)) == 0);
        render_passes(session, 4);
        CHECK(same_state(render(scene, settings, {.threads = 2}), state_of(session)));
    }
}

TEST_CASE("Films of methods and views in turns each resume where they were") {
    const SceneDescription scene = shipped_scene("door");
    const RenderSettings settings = small_settings(scene, {MethodId::Default, false});
    Session session = make_session(scene, settings, 2);
    for (const MethodId method : {MethodId::Reinforcement, MethodId::Default, MethodId::Precomputed,
                                  MethodId::Default, MethodId::Reinforcement, MethodId::Precomputed}) {
        render_passes(session, {method, View::Beauty}, 2);
        render_passes(session, {method, View::Normal}, 1);
    }
    for (const MethodInfo& method : all_methods()) {
        INFO(method.name);
        RenderSettings alone = settings;
        alone.method = method.id;
        CHECK(same_state(render(scene, alone, {.threads = 2}), state_of(session, slot_of(alone))));
    }
}

namespace {

/// The scene with normals that differ from the geometric ones, and a sky: it needs every effect.
SceneDescription with_all_effects(SceneDescription scene) {
    scene.normals = {Vec3f{0.1f, 1.0f, 0.05f}, Vec3f{-0.1f, 0.9f, 0.2f}};
    scene.triangles.front().normal = {0, 1, 0};
    scene.environment = Vec3f{0.2f, 0.3f, 0.5f};
    return scene;
}

/// One pass by the kernel compiled for `set`.
std::vector<Vec3f> render_with(Session& session, FeatureSet set, bool next_event) {
    const RenderSettings& settings = session.settings();
    const FilmSlot slot{settings.method, View::Beauty};
    RenderBackend& backend = session.backend_access();
    backend.reset_film(slot, settings.width, settings.height);
    backend.run_pass({.slot = slot,
                      .features = set,
                      .path = {.seed = 5, .next_event = next_event ? 1u : 0u},
                      .camera = make_camera(settings.camera, settings.width, settings.height)});
    return backend.read_film(slot).mean;
}

/// Number of pictures compared: for a scene without effects there are five sets without light sampling, four with.
int compare_supersets(const SceneDescription& scene) {
    int compared = 0;
    for (const Estimator estimator : kEstimators) {
        Session session = make_session(scene, small_settings(scene, estimator));
        render_passes(session, 2);  // so that paths are guided
        const FeatureSet needed = session.needed_features(slot_of(session));
        const std::vector<Vec3f> expected =
            render_with(session, kCompiledSets[smallest_superset(needed)], estimator.next_event);
        for (const FeatureSet set : kCompiledSets) {
            if (!set.covers(needed)) continue;
            INFO(scene.name << ", " << estimator << ", effects " << set.bits);
            CHECK(same_bits(expected, render_with(session, set, estimator.next_event)));
            ++compared;
        }
    }
    return compared;
}

}  // namespace

TEST_CASE("Every compiled superset of the needed effects makes the same picture") {
    int compared = compare_supersets(with_all_effects(shipped_scene("cornell")));
    for (const char* name : {"cornell", "spheres", "textured-room", "lens"})
        compared += compare_supersets(shipped_scene(name));
    CHECK(compared >= 3 * (5 + 4));
}
TEST_CASE("Every compiled superset of the needed effects makes the same picture of every shipped scene", "[merge]") {
    int compared = 0;
    for (const std::string& name : list_scenes(PL_SOURCE_DIR "/assets"))
        compared += compare_supersets(shipped_scene(name));
    // Ten shipped scenes need no effect.
    CHECK(compared >= 10 * 3 * (5 + 4));
}

// An effect of a scene must change its picture, or the test above proves nothing.
TEST_CASE("Each effect changes the picture of a scene that needs it") {
    const SceneDescription plain = shipped_scene("cornell");
    SceneDescription sky = plain;
    sky.environment = Vec3f{0.2f, 0.3f, 0.5f};
    SceneDescription smooth = plain;
    smooth.normals = with_all_effects(plain).normals;
    smooth.triangles.front().normal = {0, 1, 0};
    const RenderSettings settings = small_settings(plain, {MethodId::Default, true});
    const State expected = render(plain, settings, {.threads = 2});
    CHECK_FALSE(same_film(expected, render(sky, settings, {.threads = 2})));
    CHECK_FALSE(same_film(expected, render(smooth, settings, {.threads = 2})));
    CHECK_FALSE(same_film(expected, render(plain, small_settings(plain, {}), {.threads = 2})));

    SceneDescription painted = plain;
    painted.textures.push_back({.width = 1, .height = 1, .texels = {glm::vec4(0.9f, 0.9f, 0.9f, 1.0f)}});
    for (MaterialDescription& material : painted.materials) material.textures.albedo = 0;
    SceneDescription mapped = plain;
    mapped.environment_map = linear_sky(1.0f, 0.5f);
    SceneDescription sunny = plain;
    sunny.sun = {.direction = {0, 1, -1}, .radiance = glm::vec3(1.0f), .angle_deg = 60.0f};
    SceneDescription veiled = plain;
    for (MaterialDescription& material : veiled.materials) {
        material.opacity = 0.9f;
        material.opacity_rule = OpacityRule::Blend;
    }
    SceneDescription lens = plain;
    lens.camera.aperture_radius = 5.0f;
    for (const SceneDescription& changed :
         {painted, mapped, sunny, veiled, with_lattices(plain, glm::vec3(0.0f), glm::vec3(500.0f))})
        CHECK_FALSE(same_film(expected, render(changed, settings, {.threads = 2})));
    CHECK_FALSE(same_film(expected, render(plain, small_settings(lens, {MethodId::Default, true}), {.threads = 2})));
}

TEST_CASE("Forcing every effect on changes no bit, and a lens without an aperture is a pinhole") {
    const SceneDescription scene = shipped_scene("cornell");
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        RenderSettings settings = small_settings(scene, estimator);
        const State expected = render(scene, settings, {.threads = 2});
        settings.camera.focus_distance = 3.0f;
        for (const FeatureSet forced :
             {features(Feature::Specular), features(Feature::Textures, Feature::ThinLens), kEveryFeature}) {
            settings.forced_effects = forced;
            CHECK(same_state(expected, render(scene, settings, {.threads = 2})));
        }
    }
}
