#include "core/io/gltf/material_values.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/scene/anisotropy.h"

namespace pl {
namespace {

constexpr const char* kMoved = "a number out of the range of the format is moved into it";

/// Widths of facets along u and v.
glm::vec2 widths_of(float roughness, float strength) {
    const float width = roughness * roughness;
    return {width + (1.0f - width) * strength * strength, width};
}

}  // namespace

float clamped_number(GltfFile& file, const std::string& pointer, float standard, float least, float most) {
    const float value = file.json().number(pointer).value_or(standard);
    if (value < least || value > most) file.note(kMoved, pointer);
    return std::clamp(value, least, most);
}

glm::vec4 clamped_shares(GltfFile& file, const std::string& pointer, std::size_t length) {
    const auto given = file.json().numbers(pointer, length);
    glm::vec4 value(1.0f);
    for (std::size_t i = 0; given && i < length; ++i) value[static_cast<int>(i)] = static_cast<float>((*given)[i]);
    const glm::vec4 inside = glm::clamp(value, glm::vec4(0.0f), glm::vec4(1.0f));
    if (value != inside) file.note(kMoved, pointer);
    return inside;
}

Metalness metalness_of(const SceneDescription& scene, std::uint32_t texture, float factor) {
    if (texture == kNoTexture) return {factor, factor, factor};
    Metalness metalness{.least = 1.0f};
    double sum = 0.0;
    const std::vector<glm::vec4>& texels = scene.textures[texture].texels;
    for (const glm::vec4& texel : texels) {
        const float value = factor * texel.z;
        metalness.least = std::min(metalness.least, value);
        metalness.most = std::max(metalness.most, value);
        sum += static_cast<double>(value);
    }
    metalness.mean = static_cast<float>(sum / static_cast<double>(texels.size()));
    return metalness;
}

bool stretch_facets(SceneDescription& scene, float strength, MaterialDescription& metal) {
    std::uint32_t& texture = metal.textures.roughness;
    if (texture == kNoTexture) {
        const glm::vec2 widths = widths_of(metal.roughness, strength);
        return set_widths(metal, widths.x, widths.y);
    }
    TextureDescription image = scene.textures[texture];
    double sum = 0.0;
    for (glm::vec4& texel : image.texels) {
        const float roughness = metal.roughness * texel.x;
        sum += static_cast<double>(roughness);
        const glm::vec2 widths = widths_of(roughness, strength);
        texel.x = std::sqrt(std::sqrt(widths.x * widths.y));
    }
    const float mean = static_cast<float>(sum / static_cast<double>(image.texels.size()));
    const glm::vec2 widths = widths_of(mean, strength);
    const bool is_within = set_widths(metal, widths.x, widths.y);
    texture = static_cast<std::uint32_t>(scene.textures.size());
    scene.textures.push_back(std::move(image));
    metal.roughness = 1.0f;
    return is_within;
}

glm::vec3 color_or(const JsonDocument& document, const std::string& pointer, const glm::vec3& standard) {
    const auto given = document.numbers(pointer, 3);
    return given ? glm::vec3((*given)[0], (*given)[1], (*given)[2]) : standard;
}

}  // namespace pl
