#include "core/scene/default_light.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "core/kernel/base/math.h"
#include "core/scene/sky_map.h"
#include "core/scene/up_axis.h"

namespace pl {
namespace {

constexpr double kHalfTurn = 3.14159265358979323846;

bool shines(const glm::vec3& radiance) { return !is_black(radiance); }

bool emits(const MaterialDescription& material, const std::vector<TextureDescription>& textures) {
    if (material.textures.emission == kNoTexture) return shines(material.emission);
    const std::vector<glm::vec4>& texels = textures[material.textures.emission].texels;
    return std::any_of(texels.begin(), texels.end(),
                       [&](const glm::vec4& texel) { return shines(material.emission * glm::vec3(texel)); });
}

bool has_own_light(const SceneDescription& scene) {
    const std::vector<glm::vec3>& map = scene.environment_map.texels;
    if (shines(scene.environment) || shines(scene.sun.radiance) || std::any_of(map.begin(), map.end(), shines))
        return true;
    if (std::any_of(scene.punctual_lights.begin(), scene.punctual_lights.end(),
                    [](const PunctualLightDescription& light) { return shines(light.intensity); }))
        return true;
    std::vector<bool> emitting;
    for (const MaterialDescription& material : scene.materials) emitting.push_back(emits(material, scene.textures));
    return std::any_of(scene.triangles.begin(), scene.triangles.end(),
                       [&](const TriangleDescription& triangle) { return emitting[triangle.material]; });
}

/// Sky, ground and sun around an axis. Sums and products alone, so that every machine computes the same.
class Sky {
public:
    Sky(const glm::dvec3& up, const glm::dvec3& sun) : up_(up), sun_(sun) {}

    /// Radiance from a unit direction.
    glm::dvec3 radiance(const glm::dvec3& direction) const {
        const double height = glm::dot(direction, up_);
        const double haze = 1.0 - std::max(height, 0.0);
        const glm::dvec3 sky = glm::mix(kZenith, kHorizon, haze * haze * haze);
        const double above = glm::smoothstep(-kDusk, kDusk, height);
        return glm::mix(kGround, sky + lobe(0.5 + 0.5 * glm::dot(direction, sun_)) * kSun, above);
    }

private:
    static constexpr glm::dvec3 kZenith{0.34, 0.44, 0.60};
    static constexpr glm::dvec3 kHorizon{0.62, 0.66, 0.70};
    static constexpr glm::dvec3 kGround{0.24, 0.22, 0.20};
    static constexpr glm::dvec3 kSun{5.0, 4.7, 4.2};  ///< in its middle
    static constexpr double kDusk = 0.08;             ///< sine of the height at which the ground begins and ends

    /// x^32: one half at 17 degrees from the sun.
    static double lobe(double x) {
        for (int doubling = 0; doubling < 5; ++doubling) x *= x;
        return x;
    }

    glm::dvec3 up_;
    glm::dvec3 sun_;
};

/// Unit direction towards the sun, by scene.up and the camera.
glm::dvec3 sun_direction(const SceneDescription& scene) {
    constexpr double kHeight = 50.0 / 180.0 * kHalfTurn;
    const glm::dvec3 up(scene.up);
    const glm::dvec3 away = glm::dvec3(scene.camera.eye) - glm::dvec3(scene.camera.target);
    glm::dvec3 back = away - glm::dot(away, up) * up;
    // A camera that looks straight up or down.
    if (!(glm::length(back) > 1e-3 * glm::length(away))) back = glm::dvec3(front_of(scene.up));
    back = glm::normalize(back);
    const glm::dvec3 left = glm::cross(back, up);
    return std::sin(kHeight) * up + std::cos(kHeight) * glm::normalize(back + left);
}

/// Rounds so coarsely that differences between the sines of two machines vanish.
glm::vec3 rounded(const glm::dvec3& radiance) { return {glm::round(radiance * 0x1p12) * 0x1p-12}; }

std::string signed_axis(const glm::vec3& axis) {
    const int i = axis.x != 0.0f ? 0 : axis.y != 0.0f ? 1 : 2;
    return fmt::format("{}{}", axis[i] < 0.0f ? '-' : '+', "xyz"[i]);
}

}  // namespace

SceneLight light_of(const SceneDescription& scene) {
    if (scene.default_light) return SceneLight::Default;
    return has_own_light(scene) ? SceneLight::Own : SceneLight::None;
}

std::string_view name_of(SceneLight light) {
    switch (light) {
    case SceneLight::Own: return "scene";
    case SceneLight::Default: return "default";
    case SceneLight::None: return "none";
    }
    return "";
}

std::string light_text(const SceneDescription& scene) {
    switch (light_of(scene)) {
    case SceneLight::Own: return "the scene's own";
    case SceneLight::Default: return fmt::format("default: a sky with a soft sun, {} is up", signed_axis(scene.up));
    case SceneLight::None: return "none: every picture is black";
    }
    return "";
}

void add_default_light(SceneDescription& scene) {
    const Sky sky(glm::dvec3(scene.up), sun_direction(scene));
    scene.environment_map =
        make_sky_map(64, [&](const glm::dvec3& direction) { return rounded(sky.radiance(direction)); });
    scene.default_light = true;
}

}  // namespace pl
