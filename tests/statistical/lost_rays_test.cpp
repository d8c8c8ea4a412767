// Closed scenes lose no ray, and no scene makes an invalid sample.
#include "tests/support/catch.hpp"
#include "tests/support/scenes/closed_scenes.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/sessions.h"

using namespace pl;
using namespace pl::test;

namespace {

RenderSettings small_settings(const SceneDescription& scene, Estimator estimator) {
    RenderSettings settings = settings_for(scene, estimator, 128, 128);
    settings.field.volumes = 100;
    settings.field.bins = 64;
    return settings;
}

/// Renders until so many path segments were traced.
PassCounters trace_segments(const SceneDescription& scene, Estimator estimator, std::uint64_t segments) {
    Session session = make_session(scene, small_settings(scene, estimator));
    do session.advance(slot_of(session));
    while (session.snapshot(slot_of(session)).counters.path.segments < segments);
    return session.snapshot(slot_of(session)).counters;
}

/// No failure in N segments bounds the rate below 6.9/N with 99.9 %.
void check_closed(const SceneDescription& scene, std::uint64_t segments) {
    for (const Estimator estimator : kEstimators) {
        const PassCounters counters = trace_segments(scene, estimator, segments);
        INFO(scene.name << ", " << estimator << ", " << counters.path.segments << " segments");
        CHECK(counters.path.escaped == 0);
        CHECK(counters.invalid_samples == 0);
        CHECK(counters.path.segments >= segments);
    }
}

/// A hard room: turned, far from the origin, with walls that meet at acute angles inside.
SceneDescription turned_room(float scale, Vec3f move) {
    SceneDescription scene = shipped_scene("door");
    transform(scene, true, scale, move);
    SceneDescription camera;  // goes through the same motion
    camera.positions = {scene.camera.eye, scene.camera.target};
    transform(camera, true, scale, move);
    scene.camera.eye = camera.positions[0];
    scene.camera.target = camera.positions[1];
    scene.name = "turned room";
    return scene;
}

constexpr std::uint64_t kPush = 1'000'000;
constexpr std::uint64_t kNightly = 100'000'000;

}  // namespace

TEST_CASE("The furnace loses no ray in a million segments of every method") {
    check_closed(shipped_scene("furnace"), kPush);
}
TEST_CASE("The door ajar loses no ray in a million segments of every method") {
    check_closed(shipped_scene("door"), kPush);
}
TEST_CASE("A turned room far from the origin loses no ray in a million segments of every method") {
    check_closed(turned_room(1.0f, {100.0f, -30.0f, 50.0f}), kPush);
}

TEST_CASE("The furnace loses no ray in 1e8 segments of every method", "[nightly]") {
    check_closed(shipped_scene("furnace"), kNightly);
}
TEST_CASE("The door ajar loses no ray in 1e8 segments of every method", "[nightly]") {
    check_closed(shipped_scene("door"), kNightly);
}
TEST_CASE("A turned room far from the origin loses no ray in 1e8 segments of every method", "[nightly]") {
    check_closed(turned_room(1.0f, {100.0f, -30.0f, 50.0f}), kNightly);
}

// The box is open in front: rays escape, but every sample counts.
TEST_CASE("The Cornell box makes no invalid sample in a million segments of every method") {
    for (const Estimator estimator : kEstimators) {
        const PassCounters counters = trace_segments(shipped_scene("cornell"), estimator, kPush);
        INFO(estimator);
        CHECK(counters.invalid_samples == 0);
        CHECK(counters.path.escaped > 0);
    }
}
