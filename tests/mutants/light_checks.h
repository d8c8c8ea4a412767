// Checks of the radiance of paths: short versions of tests/statistical/furnace_test.cpp and closed_form_test.cpp.
#pragma once

#include "core/kernel/methods/default.h"
#include "tests/mutants/small_field.h"
#include "tests/mutants/trace_many.h"
#include "tests/support/field/guided_methods.h"
#include "tests/support/scenes/cube_radiosity.h"
#include "tests/support/scenes/rectangle_light.h"
#include "tests/support/statistics/rules.h"

namespace pl::test {

/// Rule S1 in every channel at the middle of a wall of a cube of known radiosity.
template <FeatureSet F, class M>
inline Decision check_cube_wall(const CubeReference& reference, const HostScene& scene, Wall wall, const M& method,
                                Range samples, double delta) {
    std::array<Moments, 3> channels;
    const PathSettings settings{.seed = 1, .next_event = F.has(Feature::NextEventEstimation) ? 1u : 0u};
    trace_many<F>(scene, camera_at_center(wall, kCubeLow, kCubeHigh), method, settings, samples,
                  [&](const PathState<F, M>& state, const PathCounters&) {
                      for (int c = 0; c < 3; ++c)
                          channels[static_cast<std::size_t>(c)].add(static_cast<double>(state.radiance[c]));
                  });
    Decision decision{Verdict::Pass, ""};
    for (int c = 0; c < 3; ++c) {
        const double truth = reference.center[wall][c];
        decision =
            worse_of(mean_equals(channels[static_cast<std::size_t>(c)], {truth, reference.error}, delta), decision);
    }
    return decision;
}

/// Floor of the cube under a bright ceiling, directions from the BSDF. Seed 1, 6e5 paths, resolves 2 %.
inline Decision check_cube() {
    const CubeReference reference = cube_with_bright_ceiling();
    return check_cube_wall<FeatureSet{}>(reference, pack_scene(cube_scene(reference)), kFloor, DefaultMethod{},
                                         {0, 600'000}, 0.02);
}

/// A wall of the cube with a lamp, lights sampled as well. Seed 1, 4e5 paths, resolves 2 %.
inline Decision check_cube_next_event() {
    const CubeReference reference = cube_with_lamp();
    return check_cube_wall<kWithNextEvent>(reference, pack_scene(cube_scene(reference)), kWallX0, DefaultMethod{},
                                           {0, 400'000}, 0.02);
}

/// The same with directions learned in 32 passes of 1000 paths. Seed 1, 1.2e6 paths, resolves 2 %.
inline Decision check_cube_guided() {
    const CubeReference reference = cube_with_lamp();
    const HostScene scene = pack_scene(cube_scene(reference));
    SmallField field(scene, 30, 8);
    const ReinforcementMethod method = guided_by(field.view());
    for (std::uint32_t pass = 0; pass < 32; ++pass) {
        trace_many<FeatureSet{}>(scene, camera_at_center(kWallX0, kCubeLow, kCubeHigh), method, {.seed = 1},
                                 {1000 * pass, 1000}, [](const auto&, const auto&) {});
        field.update();
    }
    return check_cube_wall<FeatureSet{}>(reference, scene, kWallX0, method, {1'000'000, 1'200'000}, 0.02);
}

/// Furnace with roulette from the first vertex on: survivals are geometric, so the radiance has mean e/(1-rho) and
/// variance e^2 rho/(1-rho)^2. Seed 1, 1e6 paths; the mean resolves 1 %, the variance 3 %.
inline Decision check_roulette() {
    constexpr double kRho = 0.5;
    Moments radiance, squared_deviation;
    trace_many<FeatureSet{}>(pack_scene(furnace_scene(0.5f, 0.5f)), CameraDescription{}, DefaultMethod{},
                             {.seed = 1, .roulette_start = 1}, {0, 1'000'000}, [&](const auto& state, const auto&) {
                                 const auto x = static_cast<double>(state.radiance.x);
                                 radiance.add(x);
                                 squared_deviation.add((x - 1.0) * (x - 1.0));
                             });
    return worse_of(mean_equals(radiance, {1.0}, 0.01), mean_equals(squared_deviation, {kRho}, 0.03));
}

/// Multiplies the albedos of all vertices of a path.
struct AlbedoProduct {
    SceneView scene;
    Vec3d* product;

    Hit closest_hit(const Ray& ray) const {
        const Hit hit = BvhIntersector{scene}.closest_hit(ray);
        if (hit.found()) *product *= Vec3d{scene.materials[scene.triangles[hit.primitive].material].albedo};
        return hit;
    }
    bool occluded(const Ray& ray) const { return BvhIntersector{scene}.occluded(ray); }
};

/// A box in equilibrium, emitting to the inside only, no roulette: a path brings 1 minus the product of the albedos
/// it met, whatever its directions. No sampling error, so the tolerance is rounding: 4 roundoffs per vertex. The
/// box stands off the origin, where offsets along normals are many roundoffs of its size. 2e5 paths, and not one
/// may be wrong or leave the box.
inline Decision check_equilibrium() {
    BoxLook look;
    look.albedo = {Vec3f{0.5f, 0.8f, 0.2f}, Vec3f{0.7f}, Vec3f{0.3f}, Vec3f{0.9f}, Vec3f{0.6f}, Vec3f{0.4f}};
    SceneDescription box = in_equilibrium(box_scene(look, Vec3f{40.0f}, Vec3f{41.0f}));
    for (MaterialDescription& material : box.materials) material.two_sided_emission = false;
    const HostScene scene = pack_scene(box);
    const SceneView view = scene.view();
    const PathSettings settings{.seed = 1, .max_depth = 24, .roulette_start = 1000};
    const Camera camera = make_camera(box.camera, 1, 1);
    constexpr std::uint32_t kPaths = 200'000;
    std::uint64_t wrong = 0;
    for (std::uint32_t sample = 0; sample < kPaths; ++sample) {
        Vec3d product{1.0};
        PathCounters counters;
        auto state = begin_path<FeatureSet{}, DefaultMethod>(camera, settings, {1, 1, sample}, 0);
        trace_path<FeatureSet{}>(PathContext<DefaultMethod>{view, DefaultMethod{}, settings},
                                 AlbedoProduct{view, &product}, state, counters);
        const double tolerance = 4.0 * (state.vertices + 1) * static_cast<double>(kRoundoff);
        const Vec3d off = glm::abs(Vec3d{state.radiance} - (Vec3d{1.0} - product));
        const bool right = off.x <= tolerance && off.y <= tolerance && off.z <= tolerance;
        wrong += right && counters.escaped == 0 ? 0 : 1;
    }
    return {wrong == 0 ? Verdict::Pass : Verdict::Fail,
            std::to_string(wrong) + " of " + std::to_string(kPaths) + " paths are wrong"};
}

/// Furnace paths that are cut after k vertices bring e (1 - rho^k) / (1 - rho), without sampling error: 4 roundoffs
/// per vertex. 1000 paths for each k up to 10.
inline Decision check_depth() {
    std::uint64_t wrong = 0;
    for (std::uint32_t depth = 1; depth <= 10; ++depth)
        trace_many<FeatureSet{}>(pack_scene(furnace_scene(0.5f, 0.5f)), CameraDescription{}, DefaultMethod{},
                                 {.seed = 1, .max_depth = depth, .roulette_start = 1000}, {0, 1000},
                                 [&](const auto& state, const auto&) {
                                     const float exact = 1.0f - std::pow(0.5f, static_cast<float>(depth));
                                     const float tolerance = 4.0f * static_cast<float>(depth + 1) * kRoundoff;
                                     wrong += std::fabs(state.radiance.x - exact) <= tolerance ? 0 : 1;
                                 });
    return {wrong == 0 ? Verdict::Pass : Verdict::Fail, std::to_string(wrong) + " of 10000 paths are wrong"};
}

/// A black plate hangs between a lamp and the floor: in its umbra the floor is black, exactly. 10000 paths.
inline Decision check_umbra() {
    SceneDescription lamp = lamp_above(0.1f, 0.05f).scene;
    lamp.materials.push_back({.name = "plate"});
    const std::uint32_t plate = add_vertex(lamp, {-5, 0.45f, -5});
    add_vertex(lamp, {-5, 0.45f, 5});
    add_vertex(lamp, {5, 0.45f, 5});
    add_vertex(lamp, {5, 0.45f, -5});
    add_quad(lamp, plate, plate + 1, plate + 2, plate + 3, 2);
    std::uint64_t lit = 0;
    std::uint64_t shadow_rays = 0;
    trace_many<kWithNextEvent>(pack_scene(lamp), lamp.camera, DefaultMethod{}, {.seed = 1, .next_event = 1},
                               {0, 10'000}, [&](const auto& state, const PathCounters& counters) {
                                   lit += is_black(state.radiance) ? 0 : 1;
                                   shadow_rays += counters.shadow_rays;
                               });
    const std::string reason =
        std::to_string(lit) + " paths are lit, " + std::to_string(shadow_rays) + " shadow rays";
    if (lit > 0) return {Verdict::Fail, reason};
    return {shadow_rays >= 10'000 ? Verdict::Pass : Verdict::Inconclusive, reason};
}

}  // namespace pl::test
