// Scenes with a closed form or a solved radiosity, end to end through a session: unlike the furnace they see where
// light comes from.
#include "tests/support/catch.hpp"
#include "tests/support/scenes/cube_radiosity.h"
#include "tests/support/scenes/rectangle_light.h"
#include "tests/support/session/sessions.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr int kSide = 32;
constexpr int kBatches = 64;

/// Rule S1 for the mean of a picture whose pixels all show the same point; the worst channel.
Decision judge_point(Session& session, std::uint32_t passes, double delta, glm::dvec3 expected, double error) {
    Picture picture(kSide, kSide, kSide);
    render_batches(session, picture, kBatches, passes);
    Decision worst = mean_equals(picture.channels[0].whole(), {expected[0], error}, delta);
    for (std::size_t c = 1; c < 3; ++c)
        worst =
            worse_of(worst, mean_equals(picture.channels[c].whole(), {expected[static_cast<int>(c)], error}, delta));
    return worst;
}

/// Passes per batch with which a resolution of 4 % was measured to be safe, scaled to another one.
std::uint32_t passes_for(const CubeReference& reference, Estimator estimator, double delta) {
    double base = 2.0;
    if (reference.small_light && !estimator.next_event) base = estimator.method == MethodId::Default ? 9.0 : 5.0;
    return static_cast<std::uint32_t>(std::ceil(base * (0.04 / delta) * (0.04 / delta)));
}

/// Middles of the walls of a cube, one after the other in one session: the learned field is kept.
void check_cube(const CubeReference& reference, const std::vector<Wall>& walls, double delta) {
    const SceneDescription scene = cube_scene(reference);
    for (const Estimator estimator : kEstimators) {
        RenderSettings settings = settings_for(scene, estimator, kSide, kSide);
        settings.field.volumes = 100;
        settings.field.bins = 64;
        Session session = make_session(scene, settings);
        for (const Wall wall : walls) {
            session.apply(EditCamera{camera_at_center(wall, glm::vec3(0.0f), glm::vec3(1.0f))});
            INFO(estimator << ", wall " << wall);
            CHECK(judge_point(session, passes_for(reference, estimator, delta), delta, reference.center[wall],
                              reference.error));
        }
    }
}

const std::vector<Wall> kAllWalls{kWallX0, kWallX1, kFloor, kCeiling, kWallZ0};

}  // namespace

// R18. Seed 1, 64 batches of 2 to 9 passes of 1024 paths, alpha 1e-6 per decision; resolves 4 % in every channel.
TEST_CASE("A cube under a bright ceiling has the solved radiosity") {
    check_cube(cube_with_bright_ceiling(), {kFloor, kWallX1}, 0.04);
}
TEST_CASE("A cube under a lamp has the solved radiosity") { check_cube(cube_with_lamp(), {kFloor, kWallX0}, 0.04); }

// The same at every wall, resolving 1 %: 16 times the samples.
TEST_CASE("A cube under a bright ceiling has the solved radiosity within 1 %", "[merge]") {
    check_cube(cube_with_bright_ceiling(), kAllWalls, 0.01);
}
TEST_CASE("A cube under a lamp has the solved radiosity within 1 %", "[merge]") {
    check_cube(cube_with_lamp(), kAllWalls, 0.01);
}

// And 0.3 %: 178 times the samples.
TEST_CASE("A cube under a bright ceiling has the solved radiosity within 0.3 %", "[nightly]") {
    check_cube(cube_with_bright_ceiling(), kAllWalls, 0.003);
}
TEST_CASE("A cube under a lamp has the solved radiosity within 0.3 %", "[nightly]") {
    check_cube(cube_with_lamp(), kAllWalls, 0.003);
}

namespace {

Decision judge_lamp(const LampOverFloor& lamp, Estimator estimator, View view, std::uint32_t passes, double delta) {
    RenderSettings settings = settings_for(lamp.scene, estimator, kSide, kSide);
    settings.view = view;
    settings.field.volumes = 100;
    settings.field.bins = 64;
    Session session = make_session(lamp.scene, settings);
    return judge_point(session, passes, delta, glm::dvec3{lamp.floor_radiance}, 1.0e-6);
}

}  // namespace

// R7 and R8. Seed 1, 64 x 10 passes of 1024 paths (Direct: 12), resolves 1 %: light samples see the lamp from below
// and from aside, near and far.
TEST_CASE("Light samples give the form factor of a rectangle") {
    for (const LampOverFloor& lamp :
         {lamp_above(0.1f, 0.05f), lamp_above(1.2f, 0.9f), lamp_beside(0.1f, 0.3f), lamp_beside(1.2f, 0.9f)}) {
        INFO("floor radiance " << lamp.floor_radiance);
        CHECK(judge_lamp(lamp, {MethodId::Default, true}, View::Beauty, 10, 0.01));
        CHECK(judge_lamp(lamp, {MethodId::Default, false}, View::Direct, 12, 0.01));
    }
}

// Seed 1, 64 x 9 passes of 1024 paths, resolves 2 %.
TEST_CASE("Every method gives the form factor of a rectangle") {
    for (const LampOverFloor& lamp : {lamp_above(0.1f, 0.05f), lamp_beside(0.1f, 0.3f)})
        for (const Estimator estimator : kEstimators) {
            INFO(estimator << ", floor radiance " << lamp.floor_radiance);
            CHECK(judge_lamp(lamp, estimator, View::Beauty, 9, 0.02));
        }
}
