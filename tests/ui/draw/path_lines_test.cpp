#include "ui/draw/path_lines.h"

#include <cmath>

#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"
#include "tests/ui/fake_backend.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

CameraDescription straight_camera() {
    CameraDescription camera;
    camera.eye = {0.0f, 0.0f, 0.0f};
    camera.target = {0.0f, 0.0f, -1.0f};
    camera.fov_deg = 90.0f;
    return camera;
}

const Rect kPathImage{10.0f, 20.0f, 100.0f, 100.0f};

Projection straight() { return Projection(straight_camera(), 100, 100, kPathImage); }

/// From the camera to the floor, and from there out of the scene, with a visible light sample on the way.
diagnose::PathRecord some_path() {
    diagnose::PathRecord path;
    path.radiance = Vec3f{0.5f};
    diagnose::VertexRecord floor;
    floor.origin = {0.0f, 1.0f, 4.0f};
    floor.position = {0.0f, 0.0f, 0.5f};
    floor.light = diagnose::LightSampleRecord{
        .wi = {0.0f, 1.0f, 0.0f}, .position = Vec3f{0.0f, 2.0f, 0.5f}, .is_visible = true};
    diagnose::VertexRecord escape;
    escape.is_escape = true;
    escape.origin = floor.position;
    escape.wo = {-1.0f, 0.0f, 0.0f};
    path.vertices = {floor, escape};
    return path;
}

}  // namespace

TEST_CASE("Projection: a line is cut at the near plane and at the borders of the picture") {
    const Projection projection = straight();
    // Straight ahead and to the right until far behind the camera: it leaves the picture at its right border.
    const auto line = projection.clipped({0.0f, 0.0f, -1.0f}, {3.0f, 0.0f, 2.0f});
    REQUIRE(line);
    CHECK_THAT((*line)[0].x, WithinAbs(60.0f, 1.0e-3f));
    CHECK_THAT((*line)[0].y, WithinAbs(70.0f, 1.0e-3f));
    CHECK_THAT((*line)[1].x, WithinAbs(110.0f, 1.0e-3f));
    CHECK_THAT((*line)[1].y, WithinAbs(70.0f, 1.0e-3f));
    // The same from behind.
    const auto back = projection.clipped({3.0f, 0.0f, 2.0f}, {0.0f, 0.0f, -1.0f});
    REQUIRE(back);
    CHECK_THAT((*back)[0].x, WithinAbs(110.0f, 1.0e-3f));
    CHECK_THAT((*back)[1].x, WithinAbs(60.0f, 1.0e-3f));
    CHECK_FALSE(projection.clipped({0.0f, 0.0f, 1.0f}, {1.0f, 1.0f, 2.0f}));    // behind
    CHECK_FALSE(projection.clipped({4.0f, 0.0f, -1.0f}, {4.0f, 1.0f, -1.0f}));  // beside
    CHECK(projection.clipped({-0.2f, 0.1f, -1.0f}, {0.3f, -0.2f, -2.0f}));      // inside
}

TEST_CASE("Projection: both ends of a line inside the picture are those of its points") {
    const Projection projection = straight();
    for (int i = 0; i < 50; ++i) {
        const auto t = static_cast<float>(i);
        const Vec3f a{0.4f * std::sin(t), 0.4f * std::cos(2.0f * t), -1.0f - 0.1f * t};
        const Vec3f b{0.4f * std::cos(3.0f * t), 0.4f * std::sin(t), -1.0f - 0.05f * t};
        const auto line = projection.clipped(a, b);
        REQUIRE(line);
        CHECK_THAT(glm::length((*line)[0] - projection(a)->window), WithinAbs(0.0f, 1.0e-3f));
        CHECK_THAT(glm::length((*line)[1] - projection(b)->window), WithinAbs(0.0f, 1.0e-3f));
    }
}

TEST_CASE("Path lines: a line for each ray, shadow rays on request, a casing for the selected path") {
    std::vector<PathPiece> pieces;
    add_path(pieces, some_path(), {.escape_length = 7.0f});
    REQUIRE(pieces.size() == 2);
    CHECK(pieces[0].from == Vec3f{0.0f, 1.0f, 4.0f});
    CHECK(pieces[0].to == Vec3f{0.0f, 0.0f, 0.5f});
    CHECK(pieces[1].to == Vec3f{7.0f, 0.0f, 0.5f});
    CHECK(pieces[0].color == path_color(0.5f, {}));

    pieces.clear();
    add_path(pieces, some_path(), {.has_shadow_rays = true, .is_dashed = true});
    REQUIRE(pieces.size() == 3);
    CHECK(pieces[1].to == Vec3f{0.0f, 2.0f, 0.5f});
    CHECK(pieces[1].width_px < pieces[0].width_px);
    CHECK(pieces[0].is_dashed);

    diagnose::PathRecord occluded = some_path();
    occluded.vertices[0].light->is_visible = false;
    pieces.clear();
    add_path(pieces, occluded, {.has_shadow_rays = true});
    CHECK(pieces.size() == 2);

    pieces.clear();
    add_path(pieces, some_path(), {.is_selected = true});
    REQUIRE(pieces.size() == 4);
    CHECK(pieces[0].width_px > pieces[1].width_px);
}

TEST_CASE("Path lines: colors follow the light, paths without light are gray") {
    const ValueRange range{.scale = ColorScale::Logarithmic, .low = 0.01f, .high = 1.0f};
    CHECK(path_color(0.0f, range) != path_color(0.01f, range));
    CHECK(path_color(0.1f, range) != path_color(1.0f, range));
    CHECK(path_color(1.0f, range) == path_color(5.0f, range));
}

TEST_CASE("Path lines: the part behind a surface is hidden") {
    const auto scene = pack_scene(*small_scene());
    // The floor is the square of side 2 at y = 0; from above it hides the part of a vertical line below it.
    const std::vector<PathPiece> line{{.from = {0.3f, 1.0f, 0.2f}, .to = {0.3f, -1.0f, 0.2f}}};
    const std::vector<PathPiece> parts = split_by_visibility(line, scene.view(), {0.3f, 1.5f, 0.9f});
    REQUIRE(parts.size() == 2);
    CHECK_FALSE(parts[0].is_hidden);
    CHECK(parts[1].is_hidden);
    CHECK(parts[0].from == line[0].from);
    CHECK(parts[0].to == parts[1].from);
    CHECK(parts[1].to == line[0].to);
    CHECK_THAT(parts[0].to.y, WithinAbs(0.0f, 0.1f));
}

TEST_CASE("Path lines: however many there are, the rays towards the camera are limited") {
    const auto scene = pack_scene(*small_scene());
    for (const std::size_t count : {std::size_t{10}, std::size_t{1000}, std::size_t{6000}}) {
        std::vector<PathPiece> lines;
        for (std::size_t i = 0; i < count; ++i) {
            // Across the edge of the floor, so that a change of visibility leaves more than one part.
            const float x = -0.9f + 1.8f * static_cast<float>(i) / static_cast<float>(count);
            lines.push_back({.from = {x, 1.0f, 0.0f}, .to = {x, -1.0f, 0.0f}});
        }
        const auto parts = split_by_visibility(lines, scene.view(), {0.0f, 1.9f, 0.0f});
        CHECK(parts.size() >= count);
        CHECK(parts.size() <= std::max(count, kMostVisibilityRays));
        CHECK((parts.size() > count) == (count < 4096 / 2));
    }
}

TEST_CASE("Path lines: dashes cover the line in part, hidden parts are fainter and come first") {
    const Projection projection = straight();
    PathPiece visible{.from = {-0.5f, 0.0f, -1.0f}, .to = {0.5f, 0.0f, -1.0f}, .color = 0xff00ff00u};
    PathPiece hidden = visible;
    hidden.is_hidden = true;
    const std::vector<PathPiece> pieces{visible, hidden};
    const std::vector<Stroke> strokes = strokes_of(pieces, projection, 2.0f);
    REQUIRE(strokes.size() == 2);
    CHECK((strokes[0].color >> 24) < (strokes[1].color >> 24));
    CHECK((strokes[0].color & 0xffffffu) == 0x00ff00u);
    CHECK(strokes[1].width_px == 2.0f);

    visible.is_dashed = true;
    const std::vector<Stroke> dashes = strokes_of(std::span(&visible, 1), projection, 1.0f);
    CHECK(dashes.size() > 3);
    float covered = 0.0f;
    for (const Stroke& dash : dashes) covered += glm::length(dash.to - dash.from);
    CHECK(covered > 20.0f);
    CHECK(covered < 40.0f);  // of 50 pixels
}
