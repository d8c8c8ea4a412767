// Whether closed surfaces surround the camera, so that an escaped path was lost.
#include "core/session/session.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/closed_scenes.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

namespace {

Session session_after(const SceneDescription& scene, const RenderSettings& settings, std::uint32_t passes) {
    Session session = make_session(scene, settings);
    const FilmSlot slot = slot_of(settings);
    while (session.passes(slot) < passes) session.advance(slot);
    return session;
}

}  // namespace

TEST_CASE(
    "Session diagnostics: an open scene, a room that no path leaves and a camera outside of it are not closed") {
    const SceneDescription scene = shipped_scene("cornell");
    CHECK_FALSE(session_after(scene, small_settings(scene, {MethodId::Default, false}), 1)
                    .summary({MethodId::Default, View::Beauty})
                    .is_closed);
    SceneDescription room = furnace_scene(0.5f, 0.5f);
    Session session = session_after(room, small_settings(room, {MethodId::Default, false}), 1);
    CHECK(session.summary(slot_of(session.settings())).counters.path.escaped == 0);
    CHECK_FALSE(session.summary(slot_of(session.settings())).is_closed);
    CameraDescription outside = room.camera;
    outside.eye = glm::vec3{0.0f, 0.0f, 9.0f};
    session.apply(EditCamera{outside});
    session.advance(slot_of(session.settings()));
    CHECK(session.summary(slot_of(session.settings())).counters.path.escaped > 0);
    CHECK_FALSE(session.summary(slot_of(session.settings())).is_closed);
}
