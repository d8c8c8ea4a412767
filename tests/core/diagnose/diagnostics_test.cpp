// Counts of diagnostics.
// The search for diagnostics: tracing the paths again locates as many occurrences as the passes counted.
// Marks of diagnostics in a picture.
#include "core/diagnose/diagnostics.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/kernel/film/frame_pixel.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/closed_scenes.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::diagnose;
using namespace pl::test;

TEST_CASE("Diagnostics: clamped training samples are those of the passes, of a radiance map those of its probes") {
    Snapshot snapshot{};
    snapshot.slot.method = MethodId::Reinforcement;
    snapshot.counters.path.method.clamped_records = 3;
    snapshot.field = FieldStatus{.records = 9, .clamped_records = 5};
    const auto clamped = [&] { return counted_diagnostics(snapshot)[index_of(DiagnosticKind::ClampedSample)]; };
    CHECK(clamped() == 3);
    snapshot.slot.method = MethodId::Precomputed;
    CHECK(clamped() == 5);
}

TEST_CASE("Diagnostics: a summary names kinds, counts and pixels, and how far the search came") {
    DiagnosticsMap map{.width = 2, .height = 1, .samples = 8, .traced = 8, .is_complete = true};
    map.pixels = {{3, 0, 0, 0}, {1, 2, 0, 0}};
    CHECK(summary_of(map) == "nothing wrong found");
    map.found = {4, 2, 0, 0};
    CHECK(summary_of(map) == "4 invalid in 2 pixels, 2 escaped in 1 pixel");
    map.has_moving_tables = true;
    CHECK(summary_of(map) == "4 invalid in 2 pixels, 2 escaped in 1 pixel, with the field as learned by now");
    map.is_complete = false;
    map.traced = 5;
    CHECK(summary_of(map) == "4 invalid in 2 pixels, 2 escaped in 1 pixel; traced 5 of 8 samples a pixel");
}

namespace {

/// Two walls so bright that a path that hits both has an infinite sum, and one that hits one has not.
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
    const FilmSlot slot = slot_of(settings);
    while (session.passes(slot) < passes) session.advance(slot);
    return session;
}

}  // namespace

TEST_CASE("Find diagnostics: invalid samples are located where the film counts them, by every method") {
    constexpr std::uint32_t kPasses = 2;
    const SceneDescription scene = overflowing_room();
    for (const MethodId method : {MethodId::Default, MethodId::Precomputed, MethodId::Reinforcement}) {
        RenderSettings settings = small_settings(scene, {method, false});
        settings.max_depth = 2;
        Session session = session_after(scene, settings, kPasses);
        const Snapshot snapshot = session.snapshot(slot_of(session.settings()));
        const std::uint64_t invalid = snapshot.counters.invalid_samples;
        INFO(info_of(method).name << ", " << invalid);
        REQUIRE(invalid > 60);
        REQUIRE(invalid < snapshot.counters.paths / 2);
        const DiagnosticsMap map = find_diagnostics(diagnostics_input(session, slot_of(session.settings())), 2);
        CHECK(map.is_complete);
        CHECK(map.count(DiagnosticKind::InvalidSample) == invalid);
        std::size_t nothing_else = 0;
        for (std::size_t i = 0; i < map.pixels.size(); ++i) {
            CHECK(map.pixels[i][0] <= kPasses);
            if (map.pixels[i][0] == kPasses) {
                ++nothing_else;
                CHECK(snapshot.pixels[i].x != snapshot.pixels[i].x);
            }
        }
        CHECK(nothing_else > 0);
    }
}

TEST_CASE("Find diagnostics: paths that are traced again escape as often as in their pass") {
    const SceneDescription scene = shipped_scene("cornell");
    for (const bool next_event : {false, true})
        for (const MethodId method : {MethodId::Default, MethodId::Precomputed}) {
            const Session session = session_after(scene, small_settings(scene, {method, next_event}), 3);
            const std::uint64_t escaped = session.summary(slot_of(session.settings())).counters.path.escaped;
            REQUIRE(escaped > 100);
            DiagnosticsInput source = diagnostics_input(session, slot_of(session.settings()));
            CHECK_FALSE(source.passes.is_closed);
            const DiagnosticsMap open = find_diagnostics(source, 1);
            CHECK(open.count(DiagnosticKind::EscapedPath) == 0);
            CHECK(open.is_complete);

            source.passes.is_closed = true;
            source.counted[index_of(DiagnosticKind::EscapedPath)] = escaped;
            const DiagnosticsMap map = find_diagnostics(source, 2);
            CHECK(map.count(DiagnosticKind::EscapedPath) == escaped);
            CHECK(map.is_complete);
            CHECK(map.pixel_count(DiagnosticKind::EscapedPath) > 10);
            CHECK(find_diagnostics(source, 1).pixels == map.pixels);
        }
}

TEST_CASE("Find diagnostics: a pass under way is part of the picture") {
    const SceneDescription scene = shipped_scene("cornell");
    Session session = session_after(scene, small_settings(scene, {MethodId::Default, false}, 256, 256), 1);
    StopFlag stop{true};
    REQUIRE(session.advance(slot_of(session.settings()), &stop) == Progress::Stopped);
    DiagnosticsInput source = diagnostics_input(session, slot_of(session.settings()));
    source.passes.next_pixel = 5000;  // as if it had come so far
    source.passes.is_closed = true;
    source.counted[index_of(DiagnosticKind::EscapedPath)] = ~std::uint64_t{0};
    const DiagnosticsMap both = find_diagnostics(source, 2);
    source.passes.next_pixel = 0;
    const DiagnosticsMap one = find_diagnostics(source, 2);
    std::size_t more_before = 0;
    for (std::size_t i = 0; i < one.pixels.size(); ++i) {
        more_before += both.pixels[i] != one.pixels[i] && i < 5000 ? 1u : 0u;
        if (i >= 5000) REQUIRE(both.pixels[i] == one.pixels[i]);
    }
    CHECK(more_before > 100);
}

TEST_CASE("Find diagnostics: lookup misses are located, all of them") {
    const SceneDescription scene = shipped_scene("cornell");
    RenderSettings settings = small_settings(scene, {MethodId::Precomputed, false});
    settings.field.volumes = 1;  // fewer than there are sides of surfaces
    const Session session = session_after(scene, settings, 3);
    const std::uint64_t misses = session.summary(slot_of(session.settings())).counters.path.method.lookup_misses;
    REQUIRE(misses > 100);
    const DiagnosticsMap map = find_diagnostics(diagnostics_input(session, slot_of(session.settings())), 2);
    CHECK(map.count(DiagnosticKind::LookupMiss) == misses);
}

TEST_CASE("Find diagnostics: training samples are clamped where the field is too bright, and nowhere else") {
    const SceneDescription scene = shipped_scene("cornell");
    const Session session = session_after(scene, small_settings(scene, {MethodId::Reinforcement, false}), 3);
    DiagnosticsInput source = diagnostics_input(session, slot_of(session.settings()));
    CHECK(source.passes.repeats_training);
    CHECK(source.passes.has_moving_tables);
    CHECK(source.passes.schedule.trained == 0);
    CHECK(source.counted[index_of(DiagnosticKind::ClampedSample)] == 0);
    CHECK(find_diagnostics(source, 2).traced == 0);
    source.counted[index_of(DiagnosticKind::ClampedSample)] = ~std::uint64_t{0};
    const DiagnosticsMap sound = find_diagnostics(source, 2);
    CHECK(sound.is_complete);
    CHECK(sound.traced == 3);
    CHECK(sound.count(DiagnosticKind::ClampedSample) == 0);

    for (float& mean : tables_of(source.passes.field).mean_radiance) mean = 1e6f * source.passes.shape.radiance_unit;
    CHECK(find_diagnostics(source, 2).count(DiagnosticKind::ClampedSample) > 1000);
}

TEST_CASE(
    "Find diagnostics: clamped training samples alone end the search after sixteen passes, other kinds after all") {
    const SceneDescription scene = shipped_scene("cornell");
    const Session session = session_after(scene, small_settings(scene, {MethodId::Reinforcement, false}, 12, 8), 20);
    DiagnosticsInput source = diagnostics_input(session, slot_of(session.settings()));
    ++source.counted[index_of(DiagnosticKind::ClampedSample)];
    const DiagnosticsMap some = find_diagnostics(source, 1);
    CHECK(some.is_complete);
    CHECK(some.traced == 16);
    ++source.counted[index_of(DiagnosticKind::LookupMiss)];
    const DiagnosticsMap all = find_diagnostics(source, 1);
    CHECK(all.is_complete);
    CHECK(all.traced == 20);
}

TEST_CASE("Find diagnostics: a view without paths has none, nor has a session before its first pass") {
    const SceneDescription scene = shipped_scene("cornell");
    RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, false});
    const DiagnosticsMap empty =
        find_diagnostics(diagnostics_input(make_session(scene, settings), slot_of(settings)), 2);
    CHECK(empty.is_complete);
    CHECK(empty.traced == 0);
    settings.view = View::Normal;
    CHECK_THROWS_AS(diagnostics_input(make_session(scene, settings), slot_of(settings)), Error);
}

TEST_CASE("Find diagnostics: a search that is stopped keeps its findings") {
    const SceneDescription scene = shipped_scene("cornell");
    const Session session = session_after(scene, small_settings(scene, {MethodId::Reinforcement, false}), 5);
    StopFlag stop{false};
    double seen = 0.0;
    DiagnosticsInput source = diagnostics_input(session, slot_of(session.settings()));
    ++source.counted[index_of(DiagnosticKind::ClampedSample)];
    const DiagnosticsMap map = find_diagnostics(source, 2, &stop, [&](double share) {
        seen = share;
        stop = share > 0.3;
    });
    CHECK(seen == 0.4);
    CHECK(map.traced == 2);
    CHECK_FALSE(map.is_complete);
}

TEST_CASE("Mark diagnostics: isolated pixels get rings in the color of their first kind, crowded ones none") {
    constexpr int kSide = 16;
    DiagnosticsMap map{.width = kSide, .height = kSide, .pixels = std::vector<DiagnosticsMap::Pixel>(kSide * kSide)};
    map.pixels[0] = {0, 1, 1, 0};
    map.pixels[10 * kSide + 10] = {2, 1, 0, 0};
    std::vector<std::uint32_t> argb(kSide * (kSide + 3), 0xff804020u);
    mark_diagnostics(map, {argb.data(), kSide + 3});
    const auto at = [&](int x, int y) { return argb[static_cast<std::size_t>(y * (kSide + 3) + x)]; };
    CHECK(at(0, 0) == info_of(DiagnosticKind::EscapedPath).color);
    CHECK(at(4, 0) == info_of(DiagnosticKind::EscapedPath).color);
    CHECK(at(0, 4) == info_of(DiagnosticKind::EscapedPath).color);
    CHECK(at(10, 10) == info_of(DiagnosticKind::InvalidSample).color);
    CHECK(at(14, 6) == info_of(DiagnosticKind::InvalidSample).color);
    CHECK(at(9, 9) == 0xff201008u);
    CHECK(at(kSide, 3) == 0xff804020u);
    CHECK(info_of(DiagnosticKind::InvalidSample).color == kInvalidPixel);

    std::fill(map.pixels.begin(), map.pixels.end(), DiagnosticsMap::Pixel{});
    for (std::size_t i = 0; i < 3; ++i)
        map.pixels[(2 * i + 6) * kSide + 8] = map.pixels[(2 * i + 6) * kSide + 10] = {0, 0, 0, 7};
    std::fill(argb.begin(), argb.end(), 0xff804020u);
    mark_diagnostics(map, {argb.data(), kSide + 3});
    CHECK(std::count(argb.begin(), argb.end(), info_of(DiagnosticKind::ClampedSample).color) == 6);
}
