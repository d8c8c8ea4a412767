// The weights of passes in the pictures of methods that learn while they render.
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

namespace {

/// Share of the second pass in a picture after two passes.
double second_share(const Session& session) {
    const FilmHalves halves = session.snapshot_with_halves(slot_of(session)).halves;
    REQUIRE(halves.are_both_there());
    return static_cast<double>(halves.weights[1]) / static_cast<double>(halves.weights[0] + halves.weights[1]);
}

}  // namespace

TEST_CASE(
    "The second pass of a learning method weighs twice as much as the first, and both as much with a warm field") {
    const SceneDescription scene = shipped_scene("door");
    Session session = make_session(scene, small_settings(scene, {MethodId::Reinforcement, true}, 20, 20));
    render_passes(session, 2);
    CHECK(second_share(session) == 2.0 / 3.0);
    render_passes(session, 20);
    session.apply(EditCamera{.camera = [&] {
        CameraDescription moved = scene.camera;
        moved.eye.x += 0.1f;
        return moved;
    }()});
    render_passes(session, 2);
    CHECK(second_share(session) == 0.5);
}

TEST_CASE("Passes of methods that do not learn while they render have equal weights") {
    const SceneDescription scene = shipped_scene("door");
    for (const MethodId method : {MethodId::Default, MethodId::Precomputed}) {
        Session session = make_session(scene, small_settings(scene, {method, true}, 20, 20));
        render_passes(session, 2);
        CHECK(second_share(session) == 0.5);
    }
}
