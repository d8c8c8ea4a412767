// A scene as people describe it: values joined by indices, nothing owned twice, nothing about rendering.
// Loaders in core/io fill it, validate_scene() checks it, pack_scene() turns it into arrays for the kernels.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "core/kernel/shading/surface_lobes.h"

namespace pl {

/// No texture.
inline constexpr std::uint32_t kNoTexture = 0xffffffffu;

/// Indices into SceneDescription::textures, or kNoTexture. A texture multiplies the value that it is for.
struct TextureUse {
    std::uint32_t albedo = kNoTexture;
    std::uint32_t roughness = kNoTexture;  ///< first channel
    std::uint32_t emission = kNoTexture;
    std::uint32_t opacity = kNoTexture;  ///< last channel; below one half there is a hole

    bool any() const { return (albedo & roughness & emission & opacity) != kNoTexture; }
    friend bool operator==(const TextureUse&, const TextureUse&) = default;
};

/// Indices of refraction that a surface may have. Those of solids and liquids are below 4.
inline constexpr float kLeastIor = 1.0f;
inline constexpr float kMostIor = 4.0f;

/// Angles of a sun's diameter, in degrees: what floats resolve, and half of the sky.
inline constexpr float kLeastSunAngle = 0.01f;
inline constexpr float kMostSunAngle = 180.0f;

/// A surface that may also emit. Colors are linear RGB.
struct MaterialDescription {
    std::string name;
    glm::vec3 albedo{0.0f};           ///< hemispherical reflectance of what is diffuse, each channel in [0, 1]
    glm::vec3 emission{0.0f};         ///< radiance leaving the front side, W m^-2 sr^-1
    bool two_sided_emission = false;  ///< emit from the back side too
    SurfaceKind kind = SurfaceKind::Diffuse;
    float roughness = 0.0f;        ///< in [0, 1]: root of the width alpha of GGX; 0 is a mirror
    float ior = 1.5f;              ///< dielectric and plastic: index of refraction inside over that outside
    glm::vec3 specular{1.0f};      ///< conductor: reflectance at normal incidence; others: tint of what is reflected
    glm::vec3 transmission{1.0f};  ///< dielectric: tint of what passes
    TextureUse textures{};

    friend bool operator==(const MaterialDescription&, const MaterialDescription&) = default;
};

/// What the numbers of an image file mean.
enum class TextureContent : std::uint32_t {
    Color,    ///< LDR files are decoded from sRGB
    Number,   ///< as they are; the first channel counts
    Opacity,  ///< as they are; the opacity is the alpha channel if it says anything, else the first one
};

/// An image on surfaces. Texels are linear (LDR files are decoded from sRGB where they hold colors), row by row from
/// the top; u runs to the right, v upwards, as in OBJ files.
struct TextureDescription {
    std::filesystem::path source{};
    TextureContent content = TextureContent::Color;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    bool repeats = true;              ///< outside of [0, 1]: else the border texels go on
    std::vector<glm::vec4> texels{};  ///< red, green, blue, opacity
};

/// Light from far away that depends on the direction: an image over all directions in latitude and longitude.
struct EnvironmentMapDescription {
    std::filesystem::path source{};
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    float rotation_deg = 0.0f;        ///< counter-clockwise about +y, seen from above
    std::vector<glm::vec3> texels{};  ///< radiance; first row looks up (+y), its middle column along -z
};

/// A disc in the sky.
struct SunDescription {
    glm::vec3 direction{0.0f, 1.0f, 0.0f};  ///< towards the sun
    glm::vec3 radiance{0.0f};               ///< 0: there is none
    float angle_deg = 0.533f;               ///< of the disc's diameter
};

/// Three corners and the material between them. The front side sees the corners counter-clockwise.
struct TriangleDescription {
    glm::uvec3 vertex{0};                                ///< indices into SceneDescription::positions
    glm::uvec3 normal{kNoNormal, kNoNormal, kNoNormal};  ///< indices into SceneDescription::normals, or kNoNormal
    std::uint32_t material = 0;
    glm::uvec3 uv{kNoUv, kNoUv, kNoUv};  ///< indices into SceneDescription::uvs, or kNoUv

    static constexpr std::uint32_t kNoNormal = 0xffffffffu;
    static constexpr std::uint32_t kNoUv = 0xffffffffu;
};

/// `fov_deg` is the full vertical angle. With an aperture it is a thin lens, else a pinhole.
struct CameraDescription {
    glm::vec3 eye{0.0f, 0.0f, 1.0f};
    glm::vec3 target{0.0f};
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    float fov_deg = 40.0f;
    float aperture_radius = 0.0f;  ///< of the lens
    float focus_distance = 1.0f;   ///< from the eye to the plane that is sharp, along the viewing direction
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
    std::vector<glm::vec2> uvs;
    std::vector<TriangleDescription> triangles;
    std::vector<MaterialDescription> materials;
    std::vector<TextureDescription> textures;
    CameraDescription camera;
    glm::vec3 environment{0.0f};                ///< constant radiance of everything that no surface covers
    EnvironmentMapDescription environment_map;  ///< added to it; without texels there is none
    SunDescription sun;                         ///< added to both
    std::vector<KnobDescription> knobs;
    std::vector<std::pair<std::string, std::string>> settings;  ///< option name and value the file asks for
    std::vector<std::string> warnings;                          ///< told once, by whoever loaded the scene
};

}  // namespace pl
