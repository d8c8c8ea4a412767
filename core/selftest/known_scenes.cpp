#include "core/selftest/known_scenes.h"

#include <array>
#include <cmath>

namespace pl {
namespace {

using Corners = std::array<glm::vec3, 4>;

constexpr double kPrecisePi = 3.14159265358979323846;
constexpr float kFloorAlbedo = 0.6f;

/// Counter-clockwise as seen from the front; shares no vertices.
void add_quad(SceneDescription& scene, const Corners& corners, std::uint32_t material) {
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    scene.positions.insert(scene.positions.end(), corners.begin(), corners.end());
    for (const glm::uvec3 corner : {glm::uvec3{0, 1, 2}, glm::uvec3{0, 2, 3}})
        scene.triangles.push_back({.vertex = first + corner, .material = material});
}

/// Six quads at shared positions, one material each: x0, x1, y0, y1, z0, z1.
void add_box(SceneDescription& scene, glm::vec3 low, glm::vec3 high, bool inwards,
             const std::array<std::uint32_t, 6>& materials) {
    const auto at = [&](int i) {
        return glm::vec3{(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z};
    };
    constexpr int kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (std::size_t f = 0; f < 6; ++f) {
        const auto& v = kFaces[f];
        if (inwards)
            add_quad(scene, {at(v[3]), at(v[2]), at(v[1]), at(v[0])}, materials[f]);
        else
            add_quad(scene, {at(v[0]), at(v[1]), at(v[2]), at(v[3])}, materials[f]);
    }
}

MaterialDescription diffuse(const char* name, float albedo, glm::vec3 emission = glm::vec3{0.0f}) {
    return {.name = name, .albedo = glm::vec3{albedo}, .emission = emission};
}

/// The floor y = 0 with a lamp, seen from the side in so narrow an angle that every pixel shows the same point.
SceneDescription floor_with_lamp(const Corners& lamp, glm::vec3 lamp_radiance, glm::vec3 seen) {
    SceneDescription scene;
    scene.name = "lamp";
    scene.materials = {diffuse("floor", kFloorAlbedo), diffuse("lamp", 0.0f, lamp_radiance)};
    add_quad(scene, {glm::vec3{-10, 0, -10}, {-10, 0, 10}, {10, 0, 10}, {10, 0, -10}}, 0);
    add_quad(scene, lamp, 1);
    scene.camera = {.eye = seen + glm::vec3{0.3f, 0.4f, 0.2f}, .target = seen, .fov_deg = 0.2f};
    return scene;
}

}  // namespace

SceneDescription furnace(glm::vec3 emission, float albedo) {
    SceneDescription scene;
    scene.name = "furnace";
    scene.materials = {diffuse("wall", albedo, emission)};
    add_box(scene, {-1.0f, -0.75f, -1.5f}, {1.0f, 0.75f, 1.5f}, true, {0, 0, 0, 0, 0, 0});
    scene.camera = {.eye = {0.1f, -0.2f, 1.0f}, .target = {0.0f, 0.0f, 0.0f}, .fov_deg = 70.0f};
    return scene;
}

SceneDescription lossless_block(const MaterialDescription& material) {
    SceneDescription scene;
    scene.name = "block";
    scene.materials = {material};
    add_box(scene, {-1.0f, -0.7f, -1.2f}, {1.0f, 0.9f, 0.8f}, false, {0, 0, 0, 0, 0, 0});
    scene.environment = glm::vec3{1.0f};
    scene.camera = {.eye = {1.9f, 1.6f, 3.1f}, .target = {0.0f, 0.0f, 0.0f}, .fov_deg = 40.0f};
    return scene;
}

LampScene lamp_over_floor() {
    const Corners lamp{glm::vec3{-0.4f, 0.5f, -0.3f}, {0.8f, 0.5f, -0.3f}, {0.8f, 0.5f, 0.3f}, {-0.4f, 0.5f, 0.3f}};
    // The point lies below the lamp: four rectangles meet above the point.
    const double x = 0.125;
    const double z = 0.0625;
    double factor = 0.0;
    for (const double a : {0.4 + x, 0.8 - x})
        for (const double b : {0.3 + z, 0.3 - z}) factor += parallel_corner_factor(a, b, 0.5);
    return {floor_with_lamp(lamp, glm::vec3{1.0f}, {0.125f, 0.0f, 0.0625f}),
            static_cast<double>(kFloorAlbedo) * factor};
}

LampScene lamp_beside_floor() {
    const Corners lamp{glm::vec3{-0.5f, 0.0f, 0.0f}, {0.7f, 0.0f, 0.0f}, {0.7f, 0.8f, 0.0f}, {-0.5f, 0.8f, 0.0f}};
    const double x = 0.125;
    const double z = 0.3125;
    const double factor = perpendicular_corner_factor(0.8, 0.7 - x, z) + perpendicular_corner_factor(0.8, 0.5 + x, z);
    return {floor_with_lamp(lamp, glm::vec3{1.0f}, {0.125f, 0.0f, 0.3125f}),
            static_cast<double>(kFloorAlbedo) * factor};
}

LampScene tiny_lamp() {
    constexpr float kHalf = 0.5e-3f;
    constexpr float kHeight = 1.0f;
    const Corners lamp{glm::vec3{-kHalf, kHeight, -kHalf},
                       {kHalf, kHeight, -kHalf},
                       {kHalf, kHeight, kHalf},
                       {-kHalf, kHeight, kHalf}};
    // Seen from (1, 0, 0): both cosines are 1 / sqrt(2), the distance is sqrt(2).
    constexpr float kRadiance = 1.0e6f;
    const double area = 4.0 * static_cast<double>(kHalf) * static_cast<double>(kHalf);
    return {floor_with_lamp(lamp, glm::vec3{kRadiance}, {1.0f, 0.0f, 0.0f}),
            static_cast<double>(kFloorAlbedo) / kPrecisePi * static_cast<double>(kRadiance) * area * 0.5 / 2.0};
}

SceneDescription floor_under_linear_sky(float albedo, float a, float b) {
    SceneDescription scene;
    scene.name = "sky";
    scene.materials = {diffuse("floor", albedo)};
    constexpr float kSide = 1e4f;
    add_quad(scene, {glm::vec3{-kSide, 0, -kSide}, {-kSide, 0, kSide}, {kSide, 0, kSide}, {kSide, 0, -kSide}}, 0);
    EnvironmentMapDescription& map = scene.environment_map;
    map.width = 64;
    map.height = 128;
    for (std::uint32_t row = 0; row < map.height; ++row) {
        const double cosine = std::cos(kPrecisePi * (row + 0.5) / map.height);
        map.texels.insert(map.texels.end(), map.width, glm::vec3(a + b * static_cast<float>(cosine)));
    }
    scene.camera = {.eye = {0, 1, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}};
    return scene;
}

SceneDescription cube_under_ceiling() {
    SceneDescription scene;
    scene.name = "cube";
    scene.materials = {diffuse("wall", 0.5f), diffuse("ceiling", 0.5f, glm::vec3{1.0f})};
    add_box(scene, glm::vec3{0.0f}, glm::vec3{1.0f}, true, {0, 0, 0, 1, 0, 0});
    scene.camera = {.eye = glm::vec3{0.5f}, .target = {0.5f, 0.0f, 0.5f}, .up = {0.0f, 0.0f, 1.0f}, .fov_deg = 0.5f};
    return scene;
}

SceneDescription plates_between_mirrors() {
    SceneDescription scene;
    scene.name = "plates";
    MaterialDescription mirror{.name = "mirror"};
    mirror.kind = SurfaceKind::Conductor;
    scene.materials = {mirror, diffuse("floor", 0.7f, glm::vec3{1.0f}), diffuse("ceiling", 0.4f, glm::vec3{0.25f})};
    add_box(scene, glm::vec3{0.0f}, glm::vec3{1.0f}, true, {0, 0, 1, 2, 0, 0});
    scene.camera = {.eye = glm::vec3{0.5f}, .target = {0.5f, 0.0f, 0.5f}, .up = {0.0f, 0.0f, 1.0f}, .fov_deg = 30.0f};
    return scene;
}

}  // namespace pl
