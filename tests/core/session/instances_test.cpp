// Instances in whole pictures, which equal pictures of copies in their place.
#include "core/scene/needed_effects.h"
#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/instanced_scenes.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

namespace {

State small_picture(const SceneDescription& scene, Estimator estimator, int threads) {
    return state_after(make_session(scene, small_settings(scene, estimator), threads), 6);
}

}  // namespace

TEST_CASE("Pictures of instances have the bits of pictures of copies") {
    const SceneDescription instanced = room_of_instances(materials_of_meshes());
    const SceneDescription copied = with_copies(instanced);
    CHECK(needed_effects(pack_scene(instanced)).has(Feature::Instances));
    CHECK_FALSE(needed_effects(pack_scene(copied)).has(Feature::Instances));
    REQUIRE(copied.triangles.size() == shown_triangles(instanced));
    for (const bool next_event : {false, true}) {
        INFO("light samples " << next_event);
        const Estimator estimator{MethodId::Default, next_event};
        const State expected = small_picture(copied, estimator, 2);
        CHECK(same_film(expected, small_picture(instanced, estimator, 2)));
        CHECK(same_film(expected, small_picture(instanced, estimator, 1)));
    }
}

TEST_CASE("Guided pictures of instances do not depend on the number of threads") {
    const SceneDescription scene = room_of_instances(materials_of_meshes());
    for (const MethodId method : {MethodId::Precomputed, MethodId::Reinforcement})
        for (const bool next_event : {false, true}) {
            const Estimator estimator{method, next_event};
            INFO(estimator);
            CHECK(same_state(small_picture(scene, estimator, 1), small_picture(scene, estimator, 2)));
        }
}

TEST_CASE("Volumes are placed on instances, as many as paths of the camera arrive there") {
    const SceneDescription scene = room_of_instances({{.name = "clay", .albedo = {0.7f, 0.4f, 0.3f}}});
    RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, true});
    settings.field.volumes = 400;
    Session session = make_session(scene, settings, 2);
    render_passes(session, 2);
    const HostScene packed = pack_scene(scene);
    std::size_t on_instances = 0;
    for (const SurfacePoint& site : session.export_field(MethodId::Reinforcement).volumes->sites)
        on_instances += site.primitive >= packed.planes.size() ? 1 : 0;
    CHECK(on_instances > 20);
    CHECK(on_instances < 360);
}
