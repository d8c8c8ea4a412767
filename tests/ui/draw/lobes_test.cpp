#include "ui/draw/lobes.h"

#include <algorithm>
#include <cmath>

#include "core/fields/disc_frame.h"
#include "core/kernel/base/frame.h"
#include "core/kernel/base/warp.h"
#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"
#include "tests/ui/fake_backend.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

const Rect kLobeImage{0.0f, 0.0f, 400.0f, 400.0f};

CameraDescription from(Vec3f eye, Vec3f target = Vec3f{0.0f}) {
    CameraDescription camera;
    camera.eye = eye;
    camera.target = target;
    camera.up = {0.3f, 0.9f, 0.1f};
    return camera;
}

Projection projection_from(Vec3f eye) { return Projection(from(eye), 400, 400, kLobeImage); }

LobeGlyph glyph_of(const std::vector<float>& cells, int side) {
    return {.position = Vec3f{0.0f},
            .normal = {0.0f, 1.0f, 0.0f},
            .radius = 0.5f,
            .side = side,
            .lengths = cells,
            .positions = cells};
}

/// Of all triangles of a mesh, in pixels.
float area_of(const ScreenMesh& mesh) {
    float area = 0.0f;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const Vec2f a = mesh.points[mesh.indices[i]];
        const Vec2f b = mesh.points[mesh.indices[i + 1]] - a;
        const Vec2f c = mesh.points[mesh.indices[i + 2]] - a;
        area += 0.5f * std::fabs(b.x * c.y - b.y * c.x);
    }
    return area;
}

/// A grid of flowers on the floor of a room without walls, at y = 0, in x and z from -10 to 10.
FlowerField meadow(int per_side) {
    FlowerField field;
    field.radius = 0.08f;
    for (int i = 0; i < per_side * per_side; ++i) {
        const auto at = [&](int k) {
            return -10.0f + 20.0f * (static_cast<float>(k) + 0.5f) / static_cast<float>(per_side);
        };
        std::vector<float> fine(64, 0.5f);
        fine[static_cast<std::size_t>(i % 64)] = 30.0f;
        field.flowers.push_back(
            {{at(i % per_side), 0.0f, at(i / per_side)}, {0.0f, 1.0f, 0.0f}, fine, coarser_cells(fine, 8, 4)});
    }
    return field;
}

}  // namespace

TEST_CASE("Lobes: only triangles towards the camera are drawn, and they cover the lobe") {
    const std::vector<float> cells(64, 1.0f);
    ScreenMesh mesh;
    add_glyph(mesh, glyph_of(cells, 8), LobeShape::Lobe, projection_from({2.0f, 1.0f, 0.5f}));
    CHECK(mesh.triangles() > 32);
    CHECK(mesh.triangles() < 128);
    CHECK(mesh.points.size() == mesh.colors.size());
    CHECK(area_of(mesh) > 0.0f);
    // From below the surface nothing of the outside is seen but its rim.
    ScreenMesh below;
    add_glyph(below, glyph_of(cells, 8), LobeShape::Lobe, projection_from({0.0f, -3.0f, 0.1f}));
    CHECK(below.triangles() < 8);
}

TEST_CASE("Lobes: the longest is as long as the radius, and points into its cell") {
    std::vector<float> cells(64, 0.0f);
    const int cell = 3 * 8 + 5;
    // Four cells around a corner of the grid, so that the corner has the whole value.
    for (const int other : {cell, cell + 1, cell + 8, cell + 9}) cells[static_cast<std::size_t>(other)] = 1.0f;
    const Projection projection = projection_from({2.0f, 1.5f, 1.0f});
    ScreenMesh mesh;
    add_glyph(mesh, glyph_of(cells, 8), LobeShape::Lobe, projection);
    const Vec2f corner{6.0f / 8.0f, 4.0f / 8.0f};
    const Vec3f tip = 0.5f * make_frame(Vec3f{0.0f, 1.0f, 0.0f}).to_world(lift_to_hemisphere(square_to_disk(corner)));
    const Vec2f expected = projection(tip)->window;
    const auto distance = [&](Vec2f point) { return glm::length(point - expected); };
    CHECK(std::ranges::min(mesh.points, {}, distance) == expected);

    const Vec3f peak = peak_direction({0.0f, 1.0f, 0.0f}, 8, [&] {
        cells[static_cast<std::size_t>(cell)] = 2.0f;
        return cells;
    }());
    const Vec2f disk = square_to_disk({5.5f / 8.0f, 3.5f / 8.0f});
    CHECK_THAT(glm::length(peak - make_frame(Vec3f{0.0f, 1.0f, 0.0f}).to_world(lift_to_hemisphere(disk))),
               WithinAbs(0.0f, 1.0e-5f));
}

TEST_CASE("Lobes: a dome has all its triangles, far ones first, those towards the camera nearly clear") {
    const std::vector<float> cells(64, 0.5f);
    ScreenMesh mesh;
    add_glyph(mesh, glyph_of(cells, 8), LobeShape::Dome, projection_from({0.0f, 0.4f, 3.0f}));
    REQUIRE(mesh.triangles() == 128);
    const auto alpha = [&](std::size_t i) { return mesh.colors[i] >> 24; };
    CHECK(alpha(0) > 200);                       // the inside of the far half
    CHECK(alpha(mesh.colors.size() - 1) < 100);  // the outside of the near half
}

TEST_CASE("Lobes: nothing is drawn of a glyph that reaches behind the near plane, or whose cells are missing") {
    const std::vector<float> cells(64, 1.0f);
    ScreenMesh mesh;
    add_glyph(mesh, glyph_of(cells, 8), LobeShape::Dome, projection_from({0.0f, 0.2f, 0.1f}));
    CHECK(mesh.triangles() == 0);
    add_glyph(mesh, glyph_of(cells, 4), LobeShape::Dome, projection_from({0.0f, 1.0f, 3.0f}));
    CHECK(mesh.triangles() == 0);
}

TEST_CASE("Lobes: coarser cells are means, for any division") {
    std::vector<float> cells;
    for (int i = 0; i < 16; ++i) cells.push_back(static_cast<float>(i));
    CHECK(coarser_cells(cells, 4, 2) == std::vector<float>{2.5f, 4.5f, 10.5f, 12.5f});
    CHECK(coarser_cells(cells, 4, 4) == cells);
    const std::vector<float> thirds = coarser_cells(cells, 4, 3);
    REQUIRE(thirds.size() == 9);
    CHECK(thirds[8] == 15.0f);
}

TEST_CASE("Flowers: those that are away, outside or hidden cost no triangle, and all together a bounded number") {
    const auto scene = pack_scene(*small_scene());
    FlowerField field = meadow(44);  // 1936
    REQUIRE(field.flowers.size() <= kMostFlowers);
    field.flowers[0].normal = {0.0f, -1.0f, 0.0f};
    // Close above the middle of the meadow, where flowers are large: fine ones are limited.
    FlowerCounts counts;
    const ScreenMesh mesh = flower_mesh(
        field, scene.view(), Projection(from({0.0f, 1.5f, 9.5f}, {0.0f, 0.0f, -4.0f}), 400, 400, kLobeImage), counts);
    CHECK(counts.away >= 1);
    CHECK(counts.outside > 0);
    CHECK(counts.away + counts.outside + counts.hidden + counts.drawn == field.flowers.size());
    CHECK(counts.drawn > 300);
    CHECK(mesh.triangles() == counts.triangles);
    CHECK(mesh.triangles() <= kMostFlowerTriangles);
    CHECK(mesh.triangles() < counts.drawn * 128);

    // From afar all are seen, and all are coarse.
    FlowerCounts far;
    (void)flower_mesh(field, scene.view(), Projection(from({0.0f, 60.0f, 1.0f}), 400, 400, kLobeImage), far);
    CHECK(far.drawn > 1800);
    CHECK(far.hidden > 0);  // below the light of the small scene
    CHECK(far.triangles <= far.drawn * 32);

    FlowerCounts from_below;
    CHECK(flower_mesh(field, scene.view(), Projection(from({0.0f, -20.0f, 1.0f}), 400, 400, kLobeImage), from_below)
              .triangles() == 0);
    CHECK(from_below.away + 1 == field.flowers.size());
}

TEST_CASE("Projection: a sphere is shown if any of it may be in the picture") {
    const Projection projection(from({0.0f, 0.0f, 5.0f}), 400, 400, kLobeImage);
    CHECK(projection.may_show({0.0f, 0.0f, 0.0f}, 0.1f));
    CHECK_FALSE(projection.may_show({50.0f, 0.0f, 0.0f}, 0.1f));
    CHECK(projection.may_show({50.0f, 0.0f, 0.0f}, 60.0f));
    CHECK_FALSE(projection.may_show({0.0f, 0.0f, 8.0f}, 0.1f));
    CHECK(projection.may_show({0.0f, 0.0f, 5.5f}, 1.0f));
    const float pixels = projection.pixels_of(1.0f, 5.0f);
    const Vec2f a = projection({0.0f, 0.0f, 0.0f})->window;
    Vec3f right = glm::normalize(glm::cross(Vec3f{0.0f, 0.0f, -1.0f}, Vec3f{0.3f, 0.9f, 0.1f}));
    CHECK_THAT(glm::length(projection(right)->window - a), WithinAbs(pixels, 0.01f));
}
