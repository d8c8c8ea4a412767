#include "core/io/append_triangles.h"

#include <utility>

namespace pl {
namespace {

template <class Array>
void join(Array& to, Array& from) {
    if (to.empty())
        to = std::move(from);
    else
        to.insert(to.end(), from.begin(), from.end());
}

glm::uvec3 shifted(const glm::uvec3& indices, std::size_t by) {
    return indices.x == TriangleDescription::kNoNormal ? indices : indices + static_cast<std::uint32_t>(by);
}

}  // namespace

void append_triangles(SceneDescription added, SceneDescription& scene) {
    for (TriangleDescription& triangle : added.triangles) {
        triangle.vertex = shifted(triangle.vertex, scene.positions.size());
        triangle.normal = shifted(triangle.normal, scene.normals.size());
        triangle.uv = shifted(triangle.uv, scene.uvs.size());
    }
    if (!scene.vertex_colors.empty() || !added.vertex_colors.empty()) {
        scene.vertex_colors.resize(scene.positions.size(), glm::vec3(1.0f));
        added.vertex_colors.resize(added.positions.size(), glm::vec3(1.0f));
        join(scene.vertex_colors, added.vertex_colors);
    }
    join(scene.positions, added.positions);
    join(scene.normals, added.normals);
    join(scene.uvs, added.uvs);
    join(scene.triangles, added.triangles);
    join(scene.warnings, added.warnings);
}

}  // namespace pl
