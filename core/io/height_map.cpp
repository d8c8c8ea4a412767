#include "core/io/height_map.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pl {
namespace {

/// Indices of the texels before and behind one of a row or column, and how far apart they are.
struct Neighbors {
    std::uint32_t before, behind;
    float distance;
};

Neighbors neighbors_of(std::uint32_t i, std::uint32_t count, bool repeats) {
    if (repeats) return {(i + count - 1) % count, (i + 1) % count, 2.0f};
    const std::uint32_t before = i > 0 ? i - 1 : 0;
    const std::uint32_t behind = std::min(i + 1, count - 1);
    return {before, behind, static_cast<float>(std::max(behind - before, 1u))};
}

float finite_or_none(float slope) { return std::isfinite(slope) ? slope : 0.0f; }

}  // namespace

void turn_into_normals(TextureDescription& heights, glm::vec2 rise) {
    std::vector<glm::vec4> normals(heights.texels.size());
    for (std::uint32_t row = 0; row < heights.height; ++row) {
        // Rows go down, v goes up.
        const Neighbors v = neighbors_of(row, heights.height, heights.repeats);
        for (std::uint32_t column = 0; column < heights.width; ++column) {
            const Neighbors u = neighbors_of(column, heights.width, heights.repeats);
            const auto height = [&](std::uint32_t x, std::uint32_t y) {
                return heights.texels[std::size_t{y} * heights.width + x].x;
            };
            const float along_u = rise.x * (height(u.behind, row) - height(u.before, row)) / u.distance;
            const float along_v = rise.y * (height(column, v.before) - height(column, v.behind)) / v.distance;
            const glm::vec3 normal =
                glm::normalize(glm::vec3(-finite_or_none(along_u), -finite_or_none(along_v), 1.0f));
            normals[std::size_t{row} * heights.width + column] = glm::vec4(0.5f * normal + 0.5f, 1.0f);
        }
    }
    heights.texels = std::move(normals);
}

}  // namespace pl
