// Where diagnostics was: tracing again finds as much as the passes counted, at the pixels that have it.
#include <algorithm>

#include "core/base/error.h"
#include "core/kernel/film/frame_pixel.h"
#include "core/session/diagnostics.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/closed_scenes.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

namespace {

/// Two walls so bright that a path that meets both has an infinite sum, and one that meets one has not.
SceneDescription overflowing_room() {
    BoxLook look;
    look.albedo.fill(glm::vec3{0.9f});
    look.emission[kFloor] = look.emission[kWallX1] = glm::vec3{2.5e38f};
    SceneDescription scene = box_scene(look);
    scene.camera.fov_deg = 90.0f;
    return scene;
}

Session session_after(const SceneDescription& scene, const RenderSettings& settings, std::uint32_t passes) {
    Session session = make_session(scene, settings);
    while (session.passes() < passes) session.advance();
    return session;
}

}  // namespace

TEST_CASE("Diagnostic: pixels of invalid samples are those that the film knows, by every method") {
    const SceneDescription scene = overflowing_room();
    for (const MethodId method : {MethodId::Default, MethodId::Precomputed, MethodId::Reinforcement}) {
        RenderSettings settings = small_settings(scene, {method, false});
        settings.max_depth = 2;
        Session session = session_after(scene, settings, 3);
        const Snapshot snapshot = session.snapshot();
        const std::uint64_t invalid = snapshot.counters.invalid_samples;
        INFO(info_of(method).name << ", " << invalid);
        REQUIRE(invalid > 100);
        REQUIRE(invalid < snapshot.counters.paths / 2);
        const DiagnosticsMap map = find_diagnostics(session.diagnostics_input(), 2);
        CHECK(map.is_complete);
        CHECK(map.count(Diagnostic::Invalid) == invalid);
        std::size_t nothing_else = 0;
        for (std::size_t i = 0; i < map.pixels.size(); ++i) {
            CHECK(map.pixels[i][0] <= 3u);
            if (map.pixels[i][0] == 3u) {
                ++nothing_else;
                CHECK(snapshot.pixels[i].x != snapshot.pixels[i].x);
            }
        }
        CHECK(nothing_else > 0);
    }
}

TEST_CASE("Diagnostic: paths that are traced again escape as often as they did, to the path") {
    const SceneDescription scene = shipped_scene("cornell");
    for (const bool next_event : {false, true})
        for (const MethodId method : {MethodId::Default, MethodId::Precomputed}) {
            const Session session = session_after(scene, small_settings(scene, {method, next_event}), 3);
            const std::uint64_t escaped = session.summary().counters.path.escaped;
            REQUIRE(escaped > 100);
            DiagnosticsInput source = session.diagnostics_input();
            CHECK_FALSE(source.is_closed);
            const DiagnosticsMap open = find_diagnostics(source, 1);
            CHECK(open.count(Diagnostic::Escaped) == 0);
            CHECK(open.is_complete);

            source.is_closed = true;
            source.counted[static_cast<std::size_t>(Diagnostic::Escaped)] = escaped;
            const DiagnosticsMap map = find_diagnostics(source, 2);
            CHECK(map.count(Diagnostic::Escaped) == escaped);
            CHECK(map.is_complete);
            CHECK(map.pixel_count(Diagnostic::Escaped) > 10);
            CHECK(find_diagnostics(source, 1).pixels == map.pixels);
        }
}

TEST_CASE("Diagnostic: a pass under way is part of the picture") {
    const SceneDescription scene = shipped_scene("cornell");
    Session session = session_after(scene, small_settings(scene, {MethodId::Default, false}, 256, 256), 1);
    StopFlag stop{true};
    REQUIRE(session.advance(&stop) == Progress::Stopped);
    DiagnosticsInput source = session.diagnostics_input();
    source.next_pixel = 5000;  // as if it had come so far
    source.is_closed = true;
    source.counted[static_cast<std::size_t>(Diagnostic::Escaped)] = ~std::uint64_t{0};
    const DiagnosticsMap both = find_diagnostics(source, 2);
    source.next_pixel = 0;
    const DiagnosticsMap one = find_diagnostics(source, 2);
    std::size_t more_before = 0;
    for (std::size_t i = 0; i < one.pixels.size(); ++i) {
        more_before += both.pixels[i] != one.pixels[i] && i < 5000 ? 1u : 0u;
        if (i >= 5000) REQUIRE(both.pixels[i] == one.pixels[i]);
    }
    CHECK(more_before > 100);
}

TEST_CASE("Diagnostic: points that no volume serves are found again") {
    const SceneDescription scene = shipped_scene("cornell");
    RenderSettings settings = small_settings(scene, {MethodId::Precomputed, false});
    settings.field.volumes = 1;  // fewer than there are sides of surfaces
    const Session session = session_after(scene, settings, 3);
    const std::uint64_t misses = session.summary().counters.path.method.lookup_misses;
    REQUIRE(misses > 100);
    const DiagnosticsMap map = find_diagnostics(session.diagnostics_input(), 2);
    CHECK(map.count(Diagnostic::LookupMiss) == misses);
}

TEST_CASE("Diagnostic: records are clamped where tables hold too much, and nowhere else") {
    const SceneDescription scene = shipped_scene("cornell");
    const Session session = session_after(scene, small_settings(scene, {MethodId::Reinforcement, false}), 3);
    DiagnosticsInput source = session.diagnostics_input();
    CHECK(source.has_clamped_records);
    CHECK(source.has_moving_tables);
    CHECK(source.first_sample == 0);
    CHECK(source.counted[static_cast<std::size_t>(Diagnostic::ClampedRecord)] == 0);
    CHECK(find_diagnostics(source, 2).traced == 0);
    source.counted[static_cast<std::size_t>(Diagnostic::ClampedRecord)] = ~std::uint64_t{0};
    const DiagnosticsMap sound = find_diagnostics(source, 2);
    CHECK(sound.is_complete);
    CHECK(sound.traced == 3);
    CHECK(sound.count(Diagnostic::ClampedRecord) == 0);

    for (float& mean : source.tables.mean_radiance) mean = 1e6f * source.shape.radiance_unit;
    CHECK(find_diagnostics(source, 2).count(Diagnostic::ClampedRecord) > 1000);
}

TEST_CASE("Diagnostic: for records alone the search looks at sixteen samples, for what was counted at all") {
    const SceneDescription scene = shipped_scene("cornell");
    const Session session = session_after(scene, small_settings(scene, {MethodId::Reinforcement, false}, 12, 8), 20);
    DiagnosticsInput source = session.diagnostics_input();
    ++source.counted[static_cast<std::size_t>(Diagnostic::ClampedRecord)];
    const DiagnosticsMap some = find_diagnostics(source, 1);
    CHECK(some.is_complete);
    CHECK(some.traced == 16);
    ++source.counted[static_cast<std::size_t>(Diagnostic::LookupMiss)];
    const DiagnosticsMap all = find_diagnostics(source, 1);
    CHECK(all.is_complete);
    CHECK(all.traced == 20);
}

TEST_CASE("Diagnostic: a view without paths has none, and so has a session that has not begun") {
    const SceneDescription scene = shipped_scene("cornell");
    RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, false});
    const DiagnosticsMap empty = find_diagnostics(make_session(scene, settings).diagnostics_input(), 2);
    CHECK(empty.is_complete);
    CHECK(empty.traced == 0);
    settings.view = View::Normal;
    CHECK_THROWS_AS(make_session(scene, settings).diagnostics_input(), Error);
}

TEST_CASE("Diagnostic: the search can be stopped, and keeps what it found") {
    const SceneDescription scene = shipped_scene("cornell");
    const Session session = session_after(scene, small_settings(scene, {MethodId::Reinforcement, false}), 5);
    StopFlag stop{false};
    double seen = 0.0;
    DiagnosticsInput source = session.diagnostics_input();
    ++source.counted[static_cast<std::size_t>(Diagnostic::ClampedRecord)];
    const DiagnosticsMap map = find_diagnostics(source, 2, &stop, [&](double share) {
        seen = share;
        stop = share > 0.3;
    });
    CHECK(seen == 0.4);
    CHECK(map.traced == 2);
    CHECK_FALSE(map.is_complete);
}

TEST_CASE("Diagnostic: a closed room is known as soon as a path has left, and not for a camera outside") {
    const SceneDescription scene = shipped_scene("cornell");
    CHECK_FALSE(session_after(scene, small_settings(scene, {MethodId::Default, false}), 1).summary().is_closed);
    SceneDescription room = furnace_scene(0.5f, 0.5f);
    Session session = session_after(room, small_settings(room, {MethodId::Default, false}), 1);
    CHECK(session.summary().counters.path.escaped == 0);
    CHECK_FALSE(session.summary().is_closed);
    CameraDescription outside = room.camera;
    outside.eye = glm::vec3{0.0f, 0.0f, 9.0f};
    session.apply(EditCamera{outside});
    session.advance();
    CHECK(session.summary().counters.path.escaped > 0);
    CHECK_FALSE(session.summary().is_closed);
}

TEST_CASE("Diagnostic: clamped records of the passes count, and of a map those that made it") {
    Snapshot snapshot{};
    snapshot.slot.method = MethodId::Reinforcement;
    snapshot.counters.path.method.clamped_records = 3;
    snapshot.field = FieldStatus{.records = 9, .clamped_records = 5};
    const auto clamped = [&] {
        return counted_diagnostics(snapshot)[static_cast<std::size_t>(Diagnostic::ClampedRecord)];
    };
    CHECK(clamped() == 3);
    snapshot.slot.method = MethodId::Precomputed;
    CHECK(clamped() == 5);
}

TEST_CASE("Diagnostic: marks are rings around what they mark, of the first kind that is there, but not in a crowd") {
    constexpr int kSide = 16;
    DiagnosticsMap map{.width = kSide, .height = kSide, .pixels = std::vector<DiagnosticsMap::Pixel>(kSide * kSide)};
    map.pixels[0] = {0, 1, 1, 0};
    map.pixels[10 * kSide + 10] = {2, 1, 0, 0};
    std::vector<std::uint32_t> argb(kSide * (kSide + 3), 0xff804020u);
    mark_diagnostics(map, argb.data(), kSide + 3);
    const auto at = [&](int x, int y) { return argb[static_cast<std::size_t>(y * (kSide + 3) + x)]; };
    CHECK(at(0, 0) == info_of(Diagnostic::Escaped).color);
    CHECK(at(4, 0) == info_of(Diagnostic::Escaped).color);
    CHECK(at(0, 4) == info_of(Diagnostic::Escaped).color);
    CHECK(at(10, 10) == info_of(Diagnostic::Invalid).color);
    CHECK(at(14, 6) == info_of(Diagnostic::Invalid).color);
    CHECK(at(9, 9) == 0xff201008u);
    CHECK(at(kSide, 3) == 0xff804020u);
    CHECK(info_of(Diagnostic::Invalid).color == kInvalidPixel);

    std::fill(map.pixels.begin(), map.pixels.end(), DiagnosticsMap::Pixel{});
    for (std::size_t i = 0; i < 3; ++i)
        map.pixels[(2 * i + 6) * kSide + 8] = map.pixels[(2 * i + 6) * kSide + 10] = {0, 0, 0, 7};
    std::fill(argb.begin(), argb.end(), 0xff804020u);
    mark_diagnostics(map, argb.data(), kSide + 3);
    CHECK(std::count(argb.begin(), argb.end(), info_of(Diagnostic::ClampedRecord).color) == 6);
}
