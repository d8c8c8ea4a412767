// The scene as files describe it: plain values, joined by indices, independent of rendering. Loaders in core/io fill
// it, validate_scene() checks it, pack_scene() converts it to the arrays of the kernels.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "core/kernel/shading/surface_lobes.h"

namespace pl {

/// No texture.
inline constexpr std::uint32_t kNoTexture = 0xffffffffu;

/// Indices into SceneDescription::textures, or kNoTexture. A texture multiplies its parameter, unless it says otherwise.
struct TextureUse {
    std::uint32_t albedo = kNoTexture;
    std::uint32_t roughness = kNoTexture;  ///< first channel
    std::uint32_t emission = kNoTexture;
    std::uint32_t opacity = kNoTexture;  ///< alpha channel; see OpacityRule
    std::uint32_t normal = kNoTexture;   ///< replaces the normals of the surface: see normal_map.h
    std::uint32_t blend = kNoTexture;    ///< first channel; multiplies the share of a blend

    bool any() const { return (albedo & roughness & emission & opacity & normal & blend) != kNoTexture; }
    friend bool operator==(const TextureUse&, const TextureUse&) = default;
};

/// Valid indices of refraction. Real solids and liquids are below 4.
inline constexpr float kLeastIor = 1.0f;
inline constexpr float kMostIor = 4.0f;

/// Largest factor of the slopes of a normal map.
inline constexpr float kMostNormalStrength = 100.0f;

/// Valid angular diameters of the sun, in degrees: from the resolution of floats to half of the sky.
inline constexpr float kLeastSunAngle = 0.01f;
inline constexpr float kMostSunAngle = 180.0f;

/// Largest anisotropy: facets a hundred times as wide along the surface's direction as across it.
inline constexpr float kMostAnisotropy = 0.99f;

/// The direction that green has in an image of normals.
enum class NormalGreen : std::uint32_t {
    Up,    ///< along v, up the image
    Down,  ///< down the image
    Left,  ///< to the left of u, seen from the front; on mirrored images down
};

/// How a surface shows its opacity, a number times the opacity of an image.
enum class OpacityRule : std::uint32_t {
    Threshold,  ///< below one half there is a hole, else the surface is solid
    Blend,      ///< the share of light that the surface meets; the rest goes straight on
};

/// No material.
inline constexpr std::uint32_t kNoMaterial = 0xffffffffu;

/// Another material in the place of a material's reflection and transmission, with the probability of its share.
/// Emission, opacity and normals come from the material that blends.
struct BlendDescription {
    std::uint32_t other = kNoMaterial;  ///< index into SceneDescription::materials; it may blend itself, in no circle
    float share = 0.5f;                 ///< of the other one, in [0, 1]; TextureUse::blend multiplies it

    bool is_any() const { return other != kNoMaterial; }
    friend bool operator==(const BlendDescription&, const BlendDescription&) = default;
};

/// Reflection, transmission and emission of a surface. Colors are linear RGB.
struct MaterialDescription {
    std::string name;
    glm::vec3 albedo{0.0f};           ///< hemispherical reflectance of the diffuse lobe, each channel in [0, 1]
    glm::vec3 emission{0.0f};         ///< emitted radiance of the front side, W m^-2 sr^-1
    bool two_sided_emission = false;  ///< the back side emits too
    SurfaceKind kind = SurfaceKind::Diffuse;
    float roughness = 0.0f;  ///< in [0, 1]: sqrt(alpha) of the distribution of normals; 0: smooth
    /// Rough conductor: 1 - the ratio of the smaller to the larger width of its facets, whose geometric mean is alpha.
    float anisotropy = 0.0f;
    float rotation_deg = 0.0f;     ///< of the larger width, from the direction of u towards the direction of v
    float ior = 1.5f;              ///< dielectric, plastic and pane: index of refraction, inside over outside
    glm::vec3 specular{1.0f};      ///< conductor: reflectance at normal incidence; others: tint of the reflection
    glm::vec3 edge_tint{1.0f};     ///< conductor: reflectance at 82 degrees over Schlick's approximation of it
    glm::vec3 transmission{1.0f};  ///< dielectric and pane: tint of the transmission
    glm::vec3 absorption{0.0f};    ///< dielectric: share of light that its inside absorbs per length, at least 0
    TextureUse textures{};
    float normal_strength = 1.0f;  ///< factor of the slopes in textures.normal, at least 0
    NormalGreen normal_green = NormalGreen::Up;
    float opacity = 1.0f;  ///< in [0, 1]
    OpacityRule opacity_rule = OpacityRule::Threshold;
    BlendDescription blend{};

    /// Whether rays may pass the surface as if it were not there.
    bool may_have_holes() const { return textures.opacity != kNoTexture || opacity < 1.0f; }
    bool is_anisotropic() const { return kind == SurfaceKind::Conductor && roughness > 0.0f && anisotropy > 0.0f; }
    bool absorbs() const { return kind == SurfaceKind::Dielectric && absorption != glm::vec3(0.0f); }
    friend bool operator==(const MaterialDescription&, const MaterialDescription&) = default;
};

/// Interpretation of the channels of an image file.
enum class TextureContent : std::uint32_t {
    Color,    ///< LDR files are decoded from sRGB
    Number,   ///< linear; first channel
    Opacity,  ///< linear; alpha channel unless it is constant 1, else the first channel
    Normal,   ///< linear; the first three channels
    Height,   ///< linear; the first channel, of which turn_into_normals() makes normals
};

/// An image texture. Texels are linear (colors of LDR files are decoded from sRGB), [row][column] from the top; u to
/// the right, v upwards, as in OBJ files.
struct TextureDescription {
    std::filesystem::path source{};
    TextureContent content = TextureContent::Color;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    bool repeats = true;              ///< wrap coordinates outside of [0, 1] around; else clamp them
    float gamma = 0.0f;               ///< exponent by which colors were decoded instead of by sRGB, or 0
    std::vector<glm::vec4> texels{};  ///< red, green, blue, opacity
};

/// Environment map: an image over all directions in latitude and longitude.
struct EnvironmentMapDescription {
    std::filesystem::path source{};
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    float rotation_deg = 0.0f;        ///< counter-clockwise about +y, seen from above
    std::vector<glm::vec3> texels{};  ///< [row][column], radiance; row 0 is up (+y), the middle column is -z
    glm::mat3 axes{1.0f};  ///< x, y and z of all this in the world, orthonormal; left-handed ones mirror the map
};

/// A disk of constant radiance in the sky.
struct SunDescription {
    glm::vec3 direction{0.0f, 1.0f, 0.0f};  ///< towards the sun
    glm::vec3 radiance{0.0f};               ///< 0: no sun
    float angle_deg = 0.533f;               ///< angular diameter
};

/// Kinds of lights without extent.
enum class PunctualKind : std::uint32_t { Point, Spot, Directional };
/// Fall of a spot from its inner to its outer cone.
enum class SpotFalloff : std::uint32_t {
    Cosine,  ///< the square of a linear function of the cosine   [glTF 2.0, KHR_lights_punctual]
    Angle,   ///< a linear function of the angle   [Mitsuba 3, spot]
};
/// Widest outer cone of a spot, in degrees from its axis.
inline constexpr float kMostSpotAngle = 180.0f;

/// A light without extent. Paths never hit it.
struct PunctualLightDescription {
    PunctualKind kind = PunctualKind::Point;
    glm::vec3 position{0.0f};                ///< of points and spots
    glm::vec3 direction{0.0f, 0.0f, -1.0f};  ///< in which the light of spots and directional lights travels
    /// Radiant intensity, W/sr, of a spot on its axis; directional: irradiance of a surface that faces the light, W/m^2.
    glm::vec3 intensity{0.0f};
    float inner_deg = 0.0f;   ///< half angle of the cone in which a spot has its full intensity
    float outer_deg = 45.0f;  ///< of the one outside of which it has none; at least the inner one, above 0
    SpotFalloff falloff = SpotFalloff::Cosine;

    friend bool operator==(const PunctualLightDescription&, const PunctualLightDescription&) = default;
};

/// Three corners, counter-clockwise seen from the front, and a material.
struct TriangleDescription {
    glm::uvec3 vertex{0};                                ///< indices into SceneDescription::positions
    glm::uvec3 normal{kNoNormal, kNoNormal, kNoNormal};  ///< indices into SceneDescription::normals, or kNoNormal
    std::uint32_t material = 0;
    glm::uvec3 uv{kNoUv, kNoUv, kNoUv};  ///< indices into SceneDescription::uvs, or kNoUv

    bool has_uvs() const { return uv.x != kNoUv && uv.y != kNoUv && uv.z != kNoUv; }

    static constexpr std::uint32_t kNoNormal = 0xffffffffu;
    static constexpr std::uint32_t kNoUv = 0xffffffffu;
};

/// Triangles that only instances show: a range of SceneDescription::triangles. Corners and normals are in the space of the mesh. Its
/// materials emit nothing.
struct MeshDescription {
    std::string name;
    std::uint32_t first_triangle = 0;
    std::uint32_t triangle_count = 0;
};

/// A mesh once more in the scene. `to_world` is invertible and does not mirror: its determinant is above 0.
struct InstanceDescription {
    std::uint32_t mesh = 0;  ///< index into SceneDescription::meshes
    glm::mat4x3 to_world{1.0f};
};

/// A pinhole, or a thin lens if it has an aperture. `fov_deg` is the full vertical angle.
struct CameraDescription {
    glm::vec3 eye{0.0f, 0.0f, 1.0f};
    glm::vec3 target{0.0f};
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    float fov_deg = 40.0f;
    float aperture_radius = 0.0f;  ///< of the lens; 0: pinhole
    float focus_distance = 1.0f;   ///< distance of the plane of focus, along the viewing direction
    bool is_mirrored = false;      ///< the picture shows right and left swapped
    glm::vec2 shift{
        0.0f};  ///< of the middle of the picture from the viewing direction, in heights of the picture, right and up
};

/// A camera that a file lists.
struct NamedCamera {
    std::string name;
    CameraDescription camera;
    float aspect = 0.0f;  ///< width over height of its picture; 0: any
};

/// A parameter of a scene file, mostly for the difficulty of its light transport. Loading applies `value` to the
/// geometry and materials.
struct KnobDescription {
    std::string name;
    std::string does;  ///< description for users, with the unit
    float low = 0.0f;
    float high = 0.0f;
    float default_value = 0.0f;
    float value = 0.0f;
};

/// Names of knobs and requested values; the last one of a name counts.
using KnobValues = std::vector<std::pair<std::string, float>>;

/// Names of parameters of a scene, such as its knobs, and texts of their values; the last one of a name counts.
using ParameterTexts = std::vector<std::pair<std::string, std::string>>;

/// Everything that decides the light transport of a scene, and its camera.
struct SceneDescription {
    std::string name;
    std::string summary;                       ///< one line on what it shows; may be empty
    std::filesystem::path source;              ///< the file that was opened, for messages
    std::vector<std::filesystem::path> files;  ///< looked for by the loaders, without images, which have a `source`
    glm::dvec3 origin{0.0};                    ///< of all positions here, in the file's coordinates: see far_origin()
    std::vector<glm::vec3> positions;
    /// Colors of the vertices at `positions`, each channel in [0, 1], which multiply what albedo textures multiply; or none.
    std::vector<glm::vec3> vertex_colors;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uvs;
    std::vector<TriangleDescription> triangles;  ///< of the scene directly, then of all meshes
    std::vector<MeshDescription> meshes;         ///< in the order of their triangles, without gaps
    std::vector<InstanceDescription> instances;
    std::vector<MaterialDescription> materials;
    std::vector<TextureDescription> textures;
    CameraDescription camera;
    std::vector<NamedCamera> cameras;  ///< to choose from; of some kinds of files
    std::uint32_t chosen_camera = 0;   ///< number of `camera` among them, from 1; 0: none of them
    glm::vec3 up{0.0f, 1.0f, 0.0f};    ///< vertical axis, of default camera and default light: x, y or z, +-1
    glm::vec3 environment{0.0f};       ///< constant radiance of escaped rays
    EnvironmentMapDescription environment_map;  ///< added to `environment`; no map without texels
    SunDescription sun;                         ///< added to both
    std::vector<PunctualLightDescription> punctual_lights;
    bool default_light = false;  ///< the map comes from add_default_light()
    std::vector<KnobDescription> knobs;
    std::vector<std::pair<std::string, std::string>> settings;  ///< presets: option name and value
    std::vector<std::string> warnings;                          ///< of the loaders, for the caller to report

    /// Value of a preset; empty if there is none.
    std::string_view setting(std::string_view option) const {
        for (const auto& [key, value] : settings)
            if (key == option) return value;
        return {};
    }
};

}  // namespace pl
