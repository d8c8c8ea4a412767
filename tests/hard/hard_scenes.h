// Changes of a scene that keep its light, and small scenes with one thing wrong.
#pragma once

#include "tests/support/scenes/closed_scenes.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/sessions.h"

namespace pl::test {

/// All lengths times a factor. Radiance is the same.
inline SceneDescription scaled(SceneDescription scene, float factor) {
    for (glm::vec3& position : scene.positions) position *= factor;
    scene.camera.eye *= factor;
    scene.camera.target *= factor;
    scene.camera.aperture_radius *= factor;
    scene.camera.focus_distance *= factor;
    for (PunctualLightDescription& light : scene.punctual_lights) {
        light.position *= factor;
        if (light.kind != PunctualKind::Directional) light.intensity *= factor * factor;
    }
    for (MaterialDescription& material : scene.materials) material.absorption /= factor;
    return scene;
}

/// Everything moved, the camera too.
inline SceneDescription moved(SceneDescription scene, glm::vec3 by) {
    for (glm::vec3& position : scene.positions) position += by;
    scene.camera.eye += by;
    scene.camera.target += by;
    for (PunctualLightDescription& light : scene.punctual_lights) light.position += by;
    return scene;
}

namespace hard_detail {

template <class Map>
SceneDescription mapped(SceneDescription scene, Map&& map) {
    for (std::vector<glm::vec3>* list : {&scene.positions, &scene.normals})
        for (glm::vec3& v : *list) v = map(v);
    for (glm::vec3* v : {&scene.camera.eye, &scene.camera.target, &scene.camera.up, &scene.sun.direction})
        *v = map(*v);
    return scene;
}

}  // namespace hard_detail

/// A quarter turn about the vertical axis, exact: +x goes to -z.
inline SceneDescription turned(const SceneDescription& scene) {
    SceneDescription result = hard_detail::mapped(scene, [](glm::vec3 v) { return glm::vec3{v.z, v.y, -v.x}; });
    result.environment_map.rotation_deg += 90.0f;
    return result;
}

/// Mirrored at the plane x = 0, exact. Fronts stay fronts; the picture is mirrored from left to right.
inline SceneDescription mirrored(const SceneDescription& scene) {
    SceneDescription result = hard_detail::mapped(scene, [](glm::vec3 v) { return glm::vec3{-v.x, v.y, v.z}; });
    for (TriangleDescription& triangle : result.triangles) {
        std::swap(triangle.vertex.y, triangle.vertex.z);
        std::swap(triangle.normal.y, triangle.normal.z);
        std::swap(triangle.uv.y, triangle.uv.z);
    }
    // The middle column of a map is along -z, so its rows are mirrored about it.
    EnvironmentMapDescription& map = result.environment_map;
    for (std::size_t row = 0; row < map.height && !map.texels.empty(); ++row) {
        const auto first = map.texels.begin() + static_cast<std::ptrdiff_t>(row * map.width);
        std::reverse(first, first + map.width);
    }
    map.rotation_deg = -map.rotation_deg;
    return result;
}

/// Vertices of its own; the corners run counter-clockwise as seen from the front.
inline void add_own_quad(SceneDescription& scene, const std::array<Vec3f, 4>& corners, std::uint32_t material) {
    std::uint32_t v[4];
    for (std::size_t i = 0; i < 4; ++i) v[i] = add_vertex(scene, corners[i]);
    add_quad(scene, v[0], v[1], v[2], v[3], material);
}

inline constexpr float kGrayFloor = 0.6f;

/// A gray floor y = 0, twenty wide, and a square lamp of this half width facing down at this height over the origin.
/// Material 0 is the floor, 1 the lamp.
inline SceneDescription floor_and_lamp(float half_width, float height, float radiance) {
    SceneDescription scene;
    scene.name = "floor and lamp";
    scene.materials = {gray(kGrayFloor), {.name = "lamp", .emission = Vec3f{radiance}}};
    add_own_quad(scene, {Vec3f{-10, 0, -10}, {-10, 0, 10}, {10, 0, 10}, {10, 0, -10}}, 0);
    const float s = half_width;
    add_own_quad(scene, {Vec3f{-s, height, -s}, {s, height, -s}, {s, height, s}, {-s, height, s}}, 1);
    return scene;
}

/// A view so narrow that all pixels see the same point, from `eye`.
inline CameraDescription look_at_point(Vec3f eye, Vec3f point) {
    const Vec3f view = glm::normalize(point - eye);
    return {.eye = eye,
            .target = point,
            .up = std::fabs(view.y) > 0.9f ? Vec3f{0, 0, 1} : Vec3f{0, 1, 0},
            .fov_deg = 0.05f};
}

/// The picture after some passes with small tables.
inline Snapshot picture_of(const SceneDescription& scene, Estimator estimator, int side, std::uint32_t passes,
                           int max_depth = 64) {
    RenderSettings settings = quick_learner(scene, estimator, side, 1);
    settings.max_depth = max_depth;
    Session session = make_session(scene, settings);
    render_passes(session, passes);
    return session.snapshot(slot_of(session));
}

/// Farthest that a channel of a pixel is from a value; infinite for NaN.
inline double worst_pixel(const Snapshot& snapshot, double expected) {
    double worst = 0.0;
    for (const Vec3f& pixel : snapshot.pixels)
        for (int c = 0; c < 3; ++c) {
            const double off = std::fabs(static_cast<double>(pixel[c]) - expected);
            worst = off <= worst ? worst : (off == off ? off : std::numeric_limits<double>::infinity());
        }
    return worst;
}

/// Rule S1 with the pixels as samples: they all show the same point with independent random numbers.
inline Decision pixels_mean(const Snapshot& snapshot, Reference reference, double delta) {
    Moments pixels;
    for (const Vec3f& pixel : snapshot.pixels) pixels.add(static_cast<double>(pixel.y));
    return mean_equals(pixels, reference, delta);
}

/// Defects of a picture: samples counted as invalid, and means that are not finite.
inline std::uint64_t count_broken(const Snapshot& snapshot) {
    std::uint64_t broken = snapshot.counters.invalid_samples;
    for (const Vec3f& pixel : snapshot.pixels)
        for (int c = 0; c < 3; ++c) broken += std::isfinite(pixel[c]) && pixel[c] >= 0.0f ? 0 : 1;
    return broken;
}

}  // namespace pl::test
