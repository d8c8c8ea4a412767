#include "core/io/mitsuba/textures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "core/io/line_reader.h"
#include "core/io/texture_file.h"
#include "core/kernel/base/math.h"
#include "core/scene/instances.h"

namespace pl {
namespace {

bool repeats(const MitsubaObject& texture) {
    const std::string mode = texture.text("wrap_mode").value_or("repeat");
    if (mode != "clamp" && mode != "repeat")
        texture.note(fmt::format("{} of textures is shown as repeat", in_quotes(mode)));
    return mode != "clamp";
}

/// The exponent by which values are decoded, or 0 for sRGB. [Mitsuba 3, bitmap; 0.6 has `gamma`]
float gamma_of(const MitsubaObject& bitmap) {
    if (bitmap.boolean("raw").value_or(false)) return 1.0f;
    return std::max(bitmap.number("gamma").value_or(0.0f), 0.0f);
}

TextureDescription read_bitmap(const std::filesystem::path& path, float gamma, bool wraps, SceneDescription& scene) {
    TextureDescription image =
        read_texture(path, gamma > 0.0f ? TextureContent::Normal : TextureContent::Color, wraps, scene.warnings);
    image.gamma = gamma;
    if (gamma > 0.0f && gamma != 1.0f)
        for (glm::vec4& texel : image.texels)
            texel = glm::vec4(glm::pow(glm::vec3(texel), glm::vec3(gamma)), texel.w);
    return image;
}

/// Adds an image of colors if it is new.
std::uint32_t add_colors(const MitsubaObject& bitmap, SceneDescription& scene) {
    const std::filesystem::path path = bitmap.file("filename");
    const bool wraps = repeats(bitmap);
    const float gamma = gamma_of(bitmap);
    const auto known = std::ranges::find_if(scene.textures, [&](const TextureDescription& image) {
        return image.source == path && image.content == TextureContent::Color && image.repeats == wraps &&
               image.gamma == gamma;
    });
    if (known != scene.textures.end()) return static_cast<std::uint32_t>(known - scene.textures.begin());
    return add_texture_by(scene, path, TextureContent::Color, wraps, [&] {
        TextureDescription image = read_bitmap(path, gamma, wraps, scene);
        image.content = TextureContent::Color;
        return image;
    });
}

glm::vec4 texel_of(const MitsubaObject& texture, const char* name, float standard) {
    return {glm::min(texture.color(name).value_or(glm::vec3(standard)), glm::vec3(1.0f)), 1.0f};
}

/// The first color where both or neither coordinate is in the second half of the unit square. [Mitsuba 3, checkerboard]
TextureDescription checkerboard(const MitsubaObject& texture, const SceneDescription& scene) {
    const glm::vec4 first = texel_of(texture, "color0", 0.4f);
    const glm::vec4 second = texel_of(texture, "color1", 0.2f);
    TextureDescription image{.source = scene.source, .width = kCheckerTexels, .height = kCheckerTexels, .texels = {}};
    for (std::uint32_t row = 0; row < kCheckerTexels; ++row)
        for (std::uint32_t column = 0; column < kCheckerTexels; ++column)
            image.texels.push_back((row < kCheckerTexels / 2) == (column < kCheckerTexels / 2) ? first : second);
    return image;
}

/// Adds an image with the luminance of a bitmap in one channel. Without `raw` the values are decoded from sRGB, as
/// for colors.
std::uint32_t add_luminance(const MitsubaObject& bitmap, TextureContent content, float glm::vec4::*channel,
                            SceneDescription& scene) {
    const std::filesystem::path path = bitmap.file("filename");
    const bool wraps = repeats(bitmap);
    const float gamma = gamma_of(bitmap);
    return add_texture_by(scene, path, content, wraps, [&] {
        TextureDescription image = read_bitmap(path, gamma, wraps, scene);
        image.content = content;
        for (glm::vec4& texel : image.texels) texel.*channel = luminance(Vec3f(texel));
        return image;
    });
}

/// How much u and v rise along a triangle, per length in the world, and its area.
struct UvDensity {
    double u = 0.0, v = 0.0, area = 0.0;
};

UvDensity density_of(const SceneDescription& scene, const TriangleDescription& t) {
    const glm::dvec3 p0(scene.positions[t.vertex.x]);
    const glm::dvec3 dp1 = glm::dvec3(scene.positions[t.vertex.y]) - p0;
    const glm::dvec3 dp2 = glm::dvec3(scene.positions[t.vertex.z]) - p0;
    const glm::dvec2 origin(scene.uvs[t.uv.x]);
    const glm::dvec2 uv1 = glm::dvec2(scene.uvs[t.uv.y]) - origin;
    const glm::dvec2 uv2 = glm::dvec2(scene.uvs[t.uv.z]) - origin;
    const double determinant = std::abs(uv1.x * uv2.y - uv2.x * uv1.y);
    const double u = determinant / glm::length(uv2.y * dp1 - uv1.y * dp2);
    const double v = determinant / glm::length(uv1.x * dp2 - uv2.x * dp1);
    if (!std::isfinite(u) || !std::isfinite(v)) return {};
    return {u, v, 0.5 * glm::length(glm::cross(dp1, dp2))};
}

/// Means over the area of a material's triangles, and whether they vary.
struct MeanDensity {
    UvDensity mean{};
    bool varies = false;
};

/// Sums of the powers 0, 1 and 2 of the scales by which the places of a triangle enlarge it.
struct PlaceScales {
    double count = 0.0, scale = 0.0, square = 0.0;

    void add(double by) {
        count += 1.0;
        scale += by;
        square += by * by;
    }
};

/// Scales of the direct triangles and, behind them, of the triangles of each mesh. Scales that are not uniform count
/// by their mean.
std::vector<PlaceScales> place_scales(const SceneDescription& scene) {
    std::vector<PlaceScales> scales(1 + scene.meshes.size());
    scales.front().add(1.0);
    for (const InstanceDescription& instance : scene.instances)
        scales[1 + instance.mesh].add(std::cbrt(glm::determinant(glm::dmat3(glm::mat3(instance.to_world)))));
    return scales;
}

MeanDensity mean_density(const SceneDescription& scene, std::uint32_t material) {
    UvDensity sums;
    double squares = 0.0;
    const auto add = [&](std::uint32_t first, std::uint32_t end, const PlaceScales& places) {
        for (std::uint32_t i = first; i < end; ++i) {
            const TriangleDescription& t = scene.triangles[i];
            if (t.material != material || !t.has_uvs()) continue;
            // An enlarged triangle has an area by the square of the scale, and a density by its inverse.
            const UvDensity density = density_of(scene, t);
            sums.u += density.area * density.u * places.scale;
            sums.v += density.area * density.v * places.scale;
            sums.area += density.area * places.square;
            squares += density.area * (density.u * density.u + density.v * density.v) * places.count;
        }
    };
    const std::vector<PlaceScales> scales = place_scales(scene);
    add(0, direct_triangles(scene), scales.front());
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const MeshDescription& mesh = scene.meshes[i];
        add(mesh.first_triangle, mesh.first_triangle + mesh.triangle_count, scales[1 + i]);
    }
    if (!(sums.area > 0.0)) return {};
    const UvDensity mean{sums.u / sums.area, sums.v / sums.area, sums.area};
    constexpr double kEven = 1e-3;  // relative variance
    const double square = mean.u * mean.u + mean.v * mean.v;
    return {mean, squares / sums.area > (1.0 + kEven) * square};
}

}  // namespace

std::optional<std::uint32_t> mitsuba_image(const MitsubaObject& texture, TextureContent content,
                                           SceneDescription& scene) {
    if (texture.type() == "checkerboard") {
        scene.textures.push_back(checkerboard(texture, scene));
        return static_cast<std::uint32_t>(scene.textures.size() - 1);
    }
    if (texture.type() != "bitmap") return std::nullopt;
    if (texture.text("filter_type") == "nearest") texture.note("images are interpolated between their pixels");
    if (content != TextureContent::Color) gamma_of(texture);  // of numbers, which nothing decodes
    const std::uint32_t image = content == TextureContent::Color
                                    ? add_colors(texture, scene)
                                    : add_texture(scene, texture.file("filename"), content, repeats(texture));
    return image == kNoTexture ? std::nullopt : std::optional(image);
}

std::uint32_t mitsuba_opacities(const MitsubaObject& bitmap, SceneDescription& scene) {
    const std::uint32_t image = add_luminance(bitmap, TextureContent::Opacity, &glm::vec4::w, scene);
    if (image != kNoTexture)
        for (glm::vec4& texel : scene.textures[image].texels) texel.w = std::min(texel.w, 1.0f);
    return image;
}

std::uint32_t mitsuba_shares(const MitsubaObject& texture, SceneDescription& scene) {
    std::uint32_t image = kNoTexture;
    if (texture.type() == "bitmap") {
        image = add_luminance(texture, TextureContent::Number, &glm::vec4::x, scene);
    } else if (texture.type() == "checkerboard") {
        image = *mitsuba_image(texture, TextureContent::Number, scene);
        for (glm::vec4& texel : scene.textures[image].texels) texel.x = luminance(Vec3f(texel));
    }
    if (image != kNoTexture)
        for (glm::vec4& texel : scene.textures[image].texels) texel.x = std::min(texel.x, 1.0f);
    return image;
}

glm::dmat4 mitsuba_to_uv(const MitsubaObject& texture) {
    const auto number = [&](const char* name, float standard) {
        return static_cast<double>(texture.number(name).value_or(standard));
    };
    glm::dmat4 scaled(1.0);
    scaled[0][0] = number("uscale", 1.0f);
    scaled[1][1] = number("vscale", 1.0f);
    scaled[3][0] = number("uoffset", 0.0f);
    scaled[3][1] = number("voffset", 0.0f);
    return texture.transform("to_uv") * scaled;
}

void transform_uvs(SceneDescription& scene, std::uint32_t material, const glm::dmat4& to_uv) {
    // Corners of other materials may share a coordinate: the transformed ones are new.
    std::map<std::uint32_t, std::uint32_t> moved;
    for (TriangleDescription& t : scene.triangles) {
        if (t.material != material || !t.has_uvs()) continue;
        for (int k = 0; k < 3; ++k) {
            const auto [known, is_new] = moved.try_emplace(t.uv[k], static_cast<std::uint32_t>(scene.uvs.size()));
            if (is_new) {
                const glm::dvec2 uv(scene.uvs[t.uv[k]]);
                const glm::dvec4 placed = to_uv * glm::dvec4(uv.x, 1.0 - uv.y, 0.0, 1.0);
                scene.uvs.emplace_back(placed.x, 1.0 - placed.y);
            }
            t.uv[k] = known->second;
        }
    }
}

void add_mitsuba_relief(SceneDescription& scene, std::uint32_t material, const MitsubaRelief& relief) {
    const MeanDensity density = mean_density(scene, material);
    if (!(density.mean.area > 0.0)) return;
    if (density.varies) relief.texture.note("bump maps are shown by the mean scale of their texture coordinates");
    const std::uint32_t image = add_luminance(relief.texture, TextureContent::Height, &glm::vec4::x, scene);
    if (image == kNoTexture) return;
    TextureDescription& heights = scene.textures[image];
    turn_into_normals(heights, glm::vec2(relief.scale * density.mean.u * heights.width,
                                         relief.scale * density.mean.v * heights.height));
    scene.materials[material].textures.normal = image;
}

}  // namespace pl
