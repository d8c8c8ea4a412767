#include "core/io/gltf/material_values.h"

#include <algorithm>

namespace pl {
namespace {

constexpr const char* kMoved = "a number out of the range of the format is moved into it";

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

glm::vec3 color_or(const JsonDocument& document, const std::string& pointer, const glm::vec3& standard) {
    const auto given = document.numbers(pointer, 3);
    return given ? glm::vec3((*given)[0], (*given)[1], (*given)[2]) : standard;
}

}  // namespace pl
