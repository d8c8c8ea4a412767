// A scene as people describe it: values joined by indices, nothing owned twice, nothing about rendering.
// Loaders in core/io fill it, validate_scene() checks it, pack_scene() turns it into arrays for the kernels.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

namespace pl {

/// A diffuse reflector that may also emit. Both are linear RGB.
struct MaterialDescription {
    std::string name;
    glm::vec3 albedo{0.0f};           ///< hemispherical reflectance, each channel in [0, 1]
    glm::vec3 emission{0.0f};         ///< radiance leaving the front side, W m^-2 sr^-1
    bool two_sided_emission = false;  ///< emit from the back side too
};

/// Three corners and the material between them. The front side sees the corners counter-clockwise.
struct TriangleDescription {
    glm::uvec3 vertex{0};                                ///< indices into SceneDescription::positions
    glm::uvec3 normal{kNoNormal, kNoNormal, kNoNormal};  ///< indices into SceneDescription::normals, or kNoNormal
    std::uint32_t material = 0;

    static constexpr std::uint32_t kNoNormal = 0xffffffffu;
};

/// Pinhole camera. `fov_deg` is the full vertical angle.
struct CameraDescription {
    glm::vec3 eye{0.0f, 0.0f, 1.0f};
    glm::vec3 target{0.0f};
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    float fov_deg = 40.0f;
};

/// A number that a scene file offers to turn, mostly how hard the light is to find. Loading applies it: what it moves
/// or colors is in the scene as `value` says.
struct KnobDescription {
    std::string name;
    std::string does;  ///< in words, with the unit
    float low = 0.0f;
    float high = 0.0f;
    float default_value = 0.0f;
    float value = 0.0f;
};

/// Names of knobs and the values asked for; the last one of a name counts.
using KnobValues = std::vector<std::pair<std::string, float>>;

/// Everything that decides the light in the scene, and the camera it asks to be seen from.
struct SceneDescription {
    std::string name;
    std::filesystem::path source;  ///< the file the user named, for messages
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<TriangleDescription> triangles;
    std::vector<MaterialDescription> materials;
    CameraDescription camera;
    glm::vec3 environment{0.0f};  ///< constant radiance of everything that no surface covers
    std::vector<KnobDescription> knobs;
    std::vector<std::pair<std::string, std::string>> settings;  ///< option name and value the file asks for
    std::vector<std::string> warnings;                          ///< told once, by whoever loaded the scene
};

}  // namespace pl
