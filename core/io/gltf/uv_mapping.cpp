#include "core/io/gltf/uv_mapping.h"

#include <cmath>

namespace pl {

glm::vec2 UvMapping::apply(glm::vec2 uv) const {
    const glm::vec2 scaled = scale * uv;
    const float c = std::cos(rotation);
    const float s = std::sin(rotation);
    const glm::vec2 turned(c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x);
    return {turned.x + offset.x, 1.0f - (turned.y + offset.y)};
}

UvMapping read_uv_mapping(const GltfFile& file, const std::string& info) {
    constexpr std::uint64_t kMostSets = 255;
    const std::string transform = info + "/extensions/KHR_texture_transform";
    const std::uint64_t set = file.whole(info + "/texCoord", 0, 0, kMostSets);
    const auto pair = [&](const char* key, glm::vec2 standard) {
        const auto given = file.json().numbers(transform + key, 2);
        return given ? glm::vec2((*given)[0], (*given)[1]) : standard;
    };
    return {.set = static_cast<std::uint32_t>(file.whole(transform + "/texCoord", set, 0, kMostSets)),
            .offset = pair("/offset", glm::vec2(0.0f)),
            .scale = pair("/scale", glm::vec2(1.0f)),
            .rotation = file.json().number(transform + "/rotation").value_or(0.0f)};
}

}  // namespace pl
