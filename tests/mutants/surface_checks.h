// Checks of lobes and of choosing among many lights: short versions of tests/core/kernel/shading/bsdf_test.cpp, anisotropy_test.cpp and
// light_tree_test.cpp.
#pragma once

#include "core/scene/anisotropy.h"
#include "tests/support/shading/lobe_fixture.h"
#include "tests/support/shading/many_lights.h"
#include "tests/support/statistics/rules.h"

namespace pl::test {

/// Rule S3 for rough metal, the same or not in all directions, and for rough glass from inside. 1e6 samples each, finds 3 %.
inline Decision check_facets() {
    const Decision metal =
        check_sampling(LobeSurface(rough(SurfaceKind::Conductor, 0.6f)), 0.6f, true, kFineSampling);
    const BrushedSurface brushed(rough(SurfaceKind::Conductor, 0.6f), Vec3f{0.0f},
                                 {.material = pack_anisotropy(0.6f, 0.0f), .axis = {.u = {1.0f, 0.0f, 0.0f}}});
    const Decision glass =
        check_sampling(LobeSurface(rough(SurfaceKind::Dielectric, 0.6f)), 0.8f, false, kFineSampling);
    return worse_of(worse_of(metal, check_sampling(brushed, tilted(0.6f), true, kFineSampling)), glass);
}

/// Rule S1 for white surfaces: they return all light. Their tables are good to 0.05 %. 4e5 samples each, resolves 2 %.
inline Decision check_white_surfaces() {
    Decision decision{Verdict::Pass, ""};
    for (const SurfaceKind kind : {SurfaceKind::Conductor, SurfaceKind::Plastic})
        for (const float cos_o : {0.9f, 0.3f}) {
            const LobeSurface surface(rough(kind, 0.7f), Vec3f{1.0f});
            const Moments weights = returned_light(surface, tilted(cos_o), true, 400'000);
            decision = worse_of(mean_equals(weights, {1.0, 5e-4}, 0.02), decision);
        }
    return decision;
}

/// Rule S1 for the irradiance that two hundred lights cause. Seed 9, 4e5 samples, resolves 5 %.
inline Decision check_many_lights() {
    const HostScene packed = pack_scene(scattered_lights());
    const SurfacePoint surface = receiver_at({0.2f, 0.1f, 0.0f}, {0, 1, 0});
    const double expected = summed_irradiance(packed.view(), surface);
    return mean_equals(irradiance<kMany>(packed.view(), surface, 400'000), {expected, 1e-3 * expected}, 0.05);
}

}  // namespace pl::test
