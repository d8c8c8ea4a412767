// Blended materials in whole pictures: pure at the ends of their shares, to the bit, and the same material in views.
#include "core/scene/needed_effects.h"
#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/image_scenes.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

namespace {

const MaterialDescription kMirror{.name = "mirror", .kind = SurfaceKind::Conductor, .specular = {0.9f, 0.7f, 0.4f}};

/// The Cornell box whose first material blends with a mirror.
SceneDescription blended_cornell(float share) {
    SceneDescription scene = shipped_scene("cornell");
    scene.materials.push_back(kMirror);
    scene.materials[0].blend = {.other = static_cast<std::uint32_t>(scene.materials.size() - 1), .share = share};
    return scene;
}

State picture_of_all_effects(const SceneDescription& scene, Estimator estimator) {
    RenderSettings settings = small_settings(scene, estimator);
    settings.forced_effects = kEveryFeature;
    return state_after(make_session(scene, settings, 2), 4);
}

}  // namespace

TEST_CASE("A blend without a share of the other material has the bits of a scene without it, by every method") {
    const SceneDescription pure = shipped_scene("cornell");
    SceneDescription nowhere = blended_cornell(1.0f);
    nowhere.textures.push_back(
        {.content = TextureContent::Number, .width = 1, .height = 1, .texels = {glm::vec4(0)}});
    nowhere.materials[0].textures.blend = 0;
    REQUIRE(needed_effects(pack_scene(nowhere)).has(Feature::Blends));
    CHECK_FALSE(needed_effects(pack_scene(blended_cornell(0.0f))).has(Feature::Blends));
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        const State expected = picture_of_all_effects(pure, estimator);
        CHECK(same_state(expected, picture_of_all_effects(nowhere, estimator)));
        CHECK(same_state(expected, picture_of_all_effects(blended_cornell(0.0f), estimator)));
    }
}

TEST_CASE("A blend that is all of the other material has the bits of that one") {
    SceneDescription pure = shipped_scene("cornell");
    const std::string name = pure.materials[0].name;
    pure.materials[0] = kMirror;
    pure.materials[0].name = name;
    for (const bool next_event : {false, true}) {
        const Estimator estimator{MethodId::Default, next_event};
        const State expected = picture_of_all_effects(pure, estimator);
        CHECK(same_state(expected, picture_of_all_effects(blended_cornell(1.0f), estimator)));
        CHECK_FALSE(same_film(expected, picture_of_all_effects(blended_cornell(0.5f), estimator)));
    }
}

// S1: seed 1, 64 batches of 16 passes. The camera sees nothing but a plane.
TEST_CASE("The view of albedos shows the mean of a blend") {
    SceneDescription scene = plane_scene(0.9f);
    scene.materials.push_back(gray(0.1f));
    scene.materials[0].blend = {.other = 1, .share = 0.25f};
    RenderSettings settings = settings_for(scene, {MethodId::Default, false}, 16, 16);
    settings.view = View::Albedo;
    Session session = make_session(scene, settings);
    Moments batches;
    double before = 0.0;
    for (int batch = 0; batch < 64; ++batch) {
        render_passes(session, 16);
        double after = 0.0;
        for (const Vec3d& sum : film_sums(session)) after += sum.x / 256.0;
        batches.add((after - before) / 16.0);
        before = after;
    }
    CHECK(mean_equals(batches, {0.75 * 0.9 + 0.25 * 0.1, 1e-4}, 0.02));
}
