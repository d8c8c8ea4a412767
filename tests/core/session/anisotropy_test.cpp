// Anisotropic metals in whole pictures: absent on all other surfaces, to the bit, and visible where they are.
#include "core/scene/needed_effects.h"
#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/cornell_variants.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

namespace {

State forced_picture(const SceneDescription& scene, Estimator estimator, FeatureSet forced) {
    RenderSettings settings = small_settings(scene, estimator);
    settings.forced_effects = forced;
    return state_after(make_session(scene, settings, 2), 4);
}

SceneDescription brushed_alike(float anisotropy, float rotation_deg) {
    SceneDescription scene = cornell_with_brushed_metals();
    for (MaterialDescription& material : scene.materials) {
        material.anisotropy = anisotropy;
        material.rotation_deg = rotation_deg;
    }
    return scene;
}

}  // namespace

TEST_CASE("Metals of an anisotropy of 0 have the bits of kernels without it, by every method") {
    const SceneDescription even = brushed_alike(0.0f, 30.0f);
    CHECK_FALSE(needed_effects(pack_scene(even)).has(Feature::Anisotropy));
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        CHECK(same_state(forced_picture(even, estimator, {}), forced_picture(even, estimator, kEveryFeature)));
    }
}

TEST_CASE("Mirrors and surfaces that are no metal know no anisotropy") {
    SceneDescription plain = brushed_alike(0.0f, 0.0f);
    SceneDescription named = brushed_alike(0.9f, 45.0f);
    for (SceneDescription* scene : {&plain, &named})
        for (MaterialDescription& material : scene->materials)
            if (material.kind == SurfaceKind::Conductor) material.roughness = 0.0f;
    CHECK_FALSE(needed_effects(pack_scene(named)).has(Feature::Anisotropy));
    const Estimator estimator{MethodId::Default, true};
    CHECK(same_state(forced_picture(plain, estimator, {}), forced_picture(named, estimator, {})));
}

TEST_CASE("Anisotropy and its rotation change the picture") {
    const Estimator estimator{MethodId::Default, true};
    const State even = forced_picture(brushed_alike(0.0f, 0.0f), estimator, {});
    const State along = forced_picture(brushed_alike(0.8f, 0.0f), estimator, {});
    CHECK(needed_effects(pack_scene(brushed_alike(0.8f, 0.0f))).has(Feature::Anisotropy));
    CHECK_FALSE(same_film(even, along));
    CHECK_FALSE(same_film(along, forced_picture(brushed_alike(0.8f, 90.0f), estimator, {})));
}
