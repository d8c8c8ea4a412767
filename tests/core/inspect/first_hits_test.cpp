// First surfaces by the geometry of a box, and by the views of the back end.
#include "core/inspect/first_hits.h"

#include <cmath>

#include "core/scene/pack_scene.h"
#include "core/session/session.h"
#include "cpu/cpu_backend.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/closed_scenes.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr int kWidth = 60;
constexpr int kHeight = 40;

SceneDescription box() {
    BoxLook look;
    for (int wall = 0; wall < kWalls; ++wall)
        look.albedo[static_cast<std::size_t>(wall)] = glm::vec3(0.1f * static_cast<float>(wall + 1));
    SceneDescription scene = box_scene(look);
    scene.camera.eye = {0.4f, 0.5f, 0.9f};
    scene.camera.target = {0.5f, 0.5f, 0.0f};
    scene.camera.fov_deg = 60.0f;
    return scene;
}

Snapshot view_of(const SceneDescription& scene, View view, std::uint32_t passes) {
    RenderSettings settings{.view = view};
    settings.width = kWidth;
    settings.height = kHeight;
    settings.camera = scene.camera;
    Session session(make_cpu_backend({}), std::make_shared<const SceneDescription>(scene), settings);
    while (session.passes(slot_of(settings)) < passes) session.advance(slot_of(settings));
    return session.snapshot(slot_of(settings));
}

/// Whether all neighbors have the same material.
bool is_inside(const FirstHits& hits, int x, int y) {
    const auto material = [&](int i, int j) { return hits.material[static_cast<std::size_t>(j * kWidth + i)]; };
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
            if (material(x + i, y + j) != material(x, y)) return false;
    return true;
}

}  // namespace

TEST_CASE("First hits: normals, albedo and material are those of the views, nearness is linear on a wall") {
    const SceneDescription scene = box();
    const FirstHits hits = find_first_hits(pack_scene(scene), scene.camera, kWidth, kHeight);
    const Snapshot normals = view_of(scene, View::Normal, 1);
    const Snapshot albedos = view_of(scene, View::Albedo, 1);
    int checked = 0;
    for (int y = 1; y + 1 < kHeight; ++y)
        for (int x = 1; x + 1 < kWidth; ++x) {
            if (!is_inside(hits, x, y)) continue;  // samples of the views may lie anywhere in the pixel
            const auto i = static_cast<std::size_t>(y * kWidth + x);
            const float change = hits.nearness[i + 1] - hits.nearness[i];
            const float tolerance = 1.0e-4f * hits.nearness[i];
            REQUIRE(std::fabs(hits.slope[0][i] - change) < tolerance);
            REQUIRE(std::fabs(hits.slope[1][i] - (hits.nearness[i] - hits.nearness[i - kWidth])) < tolerance);
            for (int c = 0; c < 3; ++c) {
                REQUIRE(std::fabs(0.5f * (hits.normal[c][i] + 1.0f) - normals.pixels[i][c]) < 1.0e-4f);
                REQUIRE(std::fabs(hits.albedo[c][i] - albedos.pixels[i][c]) < 1.0e-4f);
            }
            ++checked;
        }
    CHECK(checked > kWidth * kHeight / 2);
}

TEST_CASE("First hits: pixels that see nothing have no material") {
    SceneDescription scene = box();
    scene.camera.eye = {0.5f, 0.5f, 5.0f};
    scene.camera.target = {0.5f, 0.5f, 6.0f};
    const FirstHits hits = find_first_hits(pack_scene(scene), scene.camera, kWidth, kHeight);
    for (const float material : hits.material) REQUIRE(std::isnan(material));
    for (const float nearness : hits.nearness) REQUIRE(nearness == 0.0f);
}
