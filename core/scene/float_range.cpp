#include "core/scene/float_range.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "core/scene/connections.h"
#include "core/scene/far_origin.h"
#include "core/scene/instances.h"
#include "core/scene/pack_scene.h"
#include "core/scene/position_numbers.h"

namespace pl {
namespace {

/// Exponents of two of the sizes that stay as they are. Kernels multiply four lengths: with the area of a triangular light squared
/// above, and below for lights of a millionth of the scene.
constexpr int kLargestExponent = 28;
constexpr int kSmallestExponent = -10;
/// A closed surface of fewer steps of its coordinates may leak: origins of rays are up to 8 steps from where they should be.
constexpr float kFewestSteps = 64.0f;

float size_of(const glm::vec3& v) { return max_component(absolute(v)); }
/// The largest distance of neighboring floats up to a size.
float step_of(float size) { return size * std::numeric_limits<float>::epsilon(); }

template <class Change>
void for_cameras(SceneDescription& scene, Change&& change) {
    change(scene.camera);
    for (NamedCamera& camera : scene.cameras) change(camera.camera);
}

/// Exact: far_origin() is a float, and close to all that is moved.
void move_to_origin(SceneDescription& scene, const glm::vec3& middle) {
    // Meshes of instances have vertices of their own, which stay.
    std::vector<bool> is_of_mesh(scene.positions.size(), false);
    for (std::size_t i = direct_triangles(scene); i < scene.triangles.size(); ++i)
        for (int k = 0; k < 3; ++k) is_of_mesh[scene.triangles[i].vertex[k]] = true;
    for (std::size_t i = 0; i < scene.positions.size(); ++i)
        if (!is_of_mesh[i]) scene.positions[i] -= middle;
    for (InstanceDescription& instance : scene.instances) instance.to_world[3] -= middle;
    for_cameras(scene, [&](CameraDescription& camera) {
        camera.eye -= middle;
        camera.target -= middle;
    });
    for (PunctualLightDescription& light : scene.punctual_lights) light.position -= middle;
    scene.origin += glm::dvec3(middle);
}

void scale_lengths(SceneDescription& scene, float scale) {
    for (glm::vec3& position : scene.positions) position *= scale;
    for (InstanceDescription& instance : scene.instances) instance.to_world[3] *= scale;
    for_cameras(scene, [&](CameraDescription& camera) {
        camera.eye *= scale;
        camera.target *= scale;
        camera.aperture_radius *= scale;
        camera.focus_distance *= scale;
    });
    for (PunctualLightDescription& light : scene.punctual_lights) {
        light.position *= scale;
        if (light.kind != PunctualKind::Directional) light.intensity *= scale * scale;
    }
    for (MaterialDescription& material : scene.materials) material.absorption /= scale;
    scene.origin *= scale;
}

/// A triangle, or a surface of small ones, by its bounds.
struct SmallSurface {
    Bounds bounds;
    bool touches_larger = false;  ///< shares a corner with a triangle that is large enough

    float extent() const { return size_of(bounds.high - bounds.low); }
    float reach() const { return max_of(size_of(bounds.low), size_of(bounds.high)); }
    bool is_unresolved() const { return extent() < kFewestSteps * step_of(reach()); }
    /// Triangles of two or three equal corners are nowhere.
    bool is_leaky() const { return extent() > 0.0f && !touches_larger && is_unresolved(); }
};

/// Calls fn(triangle, is unresolved) for the direct triangles.
template <class Fn>
void for_triangles(const SceneDescription& scene, Fn&& fn) {
    for (std::uint32_t i = 0; i < direct_triangles(scene); ++i) {
        SmallSurface triangle;
        for (int k = 0; k < 3; ++k) triangle.bounds.add(scene.positions[scene.triangles[i].vertex[k]]);
        fn(scene.triangles[i], triangle.is_unresolved());
    }
}

/// The surfaces made of triangles that are unresolved each. Vertices at equal positions count as one.
std::vector<SmallSurface> small_surfaces(const SceneDescription& scene) {
    std::vector<glm::uvec3> small;
    for_triangles(scene, [&](const TriangleDescription& t, bool is_unresolved) {
        if (is_unresolved) small.push_back(t.vertex);
    });
    if (small.empty()) return {};
    PositionNumbers numbers(3 * small.size());
    for (glm::uvec3& corners : small)
        for (int k = 0; k < 3; ++k) corners[k] = numbers.number_of(scene.positions[corners[k]]);
    Connections connections(numbers.count());
    for (const glm::uvec3& corners : small) {
        connections.join(corners.x, corners.y);
        connections.join(corners.y, corners.z);
    }
    std::vector<SmallSurface> surfaces(numbers.count());
    for (std::uint32_t i = 0; i < numbers.count(); ++i) surfaces[connections.root(i)].bounds.add(numbers.position(i));
    for_triangles(scene, [&](const TriangleDescription& t, bool is_unresolved) {
        for (int k = 0; k < 3 && !is_unresolved; ++k) {
            const std::uint32_t number = numbers.find(scene.positions[t.vertex[k]]);
            if (number != PositionNumbers::kFree) surfaces[connections.root(number)].touches_larger = true;
        }
    });
    return surfaces;
}

/// A camera that is too far, or nothing.
std::string far_camera_text(const SceneDescription& scene) {
    const Bounds bounds = bounds_of(scene);
    const float eye = size_of(scene.camera.eye);
    const float extent = size_of(bounds.high - bounds.low);
    if (extent >= kFewestSteps * step_of(eye)) return {};
    return fmt::format("{} wide, but the camera is {} away, {} times as far: floats there have steps of {}", extent,
                       eye, eye / extent, step_of(eye));
}

/// Surfaces that are too small, or nothing.
std::string small_surfaces_text(const SceneDescription& scene) {
    std::size_t count = 0;
    const SmallSurface* worst = nullptr;
    const std::vector<SmallSurface> surfaces = small_surfaces(scene);
    for (const SmallSurface& surface : surfaces) {
        if (surface.bounds.empty() || !surface.is_leaky()) continue;
        ++count;
        if (worst == nullptr || surface.extent() * worst->reach() < worst->extent() * surface.reach())
            worst = &surface;
    }
    if (worst == nullptr) return {};
    return fmt::format("{} surfaces are too small for their distance from the origin, at the worst {} wide at {}, "
                       "where floats have steps of {}: light may pass their walls",
                       count, worst->extent(), worst->reach(), step_of(worst->reach()));
}

}  // namespace

bool move_into_float_range(SceneDescription& scene) {
    const Bounds bounds = bounds_of(scene);
    const glm::vec3 origin(far_origin(glm::dvec3(bounds.low), glm::dvec3(bounds.high)));
    if (origin != glm::vec3(0.0f)) {
        move_to_origin(scene, origin);
        scene.warnings.push_back(fmt::format("{}: positions were floats before the move, in steps of up to {}",
                                             scene.source.string(), step_of(size_of(origin))));
        tell_origin(scene);
    }
    const float size = std::max(size_of(bounds.low - origin), size_of(bounds.high - origin));
    const int exponent = size > 0.0f ? std::ilogb(size) : 0;
    if (exponent <= kLargestExponent && exponent >= kSmallestExponent) return origin != glm::vec3(0.0f);
    scale_lengths(scene, std::ldexp(1.0f, -exponent));
    scene.warnings.push_back(fmt::format(
        "{}: up to {} from the origin, of which floats hold no fourth power: all lengths times 2^{}, also those of "
        "--eye, --target and camera files",
        scene.source.string(), size, -exponent));
    return true;
}

void warn_of_float_steps(SceneDescription& scene) {
    for (const std::string& text : {far_camera_text(scene), small_surfaces_text(scene)})
        if (!text.empty()) scene.warnings.push_back(fmt::format("{}: {}", scene.source.string(), text));
}

}  // namespace pl
