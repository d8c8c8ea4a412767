#include "core/io/gltf/copy_primitive.h"

#include <cmath>

#include <fmt/format.h>

#include "core/io/triangle_area.h"

namespace pl {
namespace {

constexpr glm::vec3 kWhite(1.0f);

/// Transformation of normals: the inverse transposed without its factor, which may be infinite.
glm::dmat3 normal_transform(const glm::dmat3& m) {
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    return glm::dot(cofactors[0], m[0]) < 0.0 ? -cofactors : cofactors;
}

class PrimitiveCopier {
public:
    PrimitiveCopier(GltfFile& file, const GltfPrimitive& primitive, const GltfPlace& place, SceneDescription& to)
        : file_(file), primitive_(primitive), place_(place), to_(to),
          is_skinned_(!place.joints.empty() && !primitive.joints.empty()),
          first_vertex_(static_cast<std::uint32_t>(to.positions.size())),
          first_normal_(static_cast<std::uint32_t>(to.normals.size())),
          first_uv_(static_cast<std::uint32_t>(to.uvs.size())) {}

    void add_vertices() {
        glm::dmat3 turn = normal_transform(glm::dmat3(place_.to_world));
        for (std::size_t i = 0; i < primitive_.positions.size(); ++i) {
            const glm::dmat4 matrix = is_skinned_ ? skin_transform(i) : place_.to_world;
            add_position(glm::dvec3(matrix * glm::dvec4(glm::dvec3(primitive_.positions[i]), 1.0)));
            if (primitive_.normals.empty()) continue;
            turn = is_skinned_ ? normal_transform(glm::dmat3(matrix)) : turn;
            const glm::dvec3 normal = turn * glm::dvec3(primitive_.normals[i]);
            const double length = glm::length(normal);
            const bool is_usable = length > 0.0 && std::isfinite(length);
            to_.normals.push_back(is_usable ? glm::vec3(normal / length) : glm::vec3(0.0f));
        }
        to_.uvs.insert(to_.uvs.end(), primitive_.uvs.begin(), primitive_.uvs.end());
        if (primitive_.colors.empty()) return;
        to_.vertex_colors.resize(first_vertex_, kWhite);
        to_.vertex_colors.insert(to_.vertex_colors.end(), primitive_.colors.begin(), primitive_.colors.end());
    }

    void add_triangles(std::uint32_t material) {
        const bool is_mirrored = !is_skinned_ && glm::determinant(glm::dmat3(place_.to_world)) < 0.0;
        for (std::array<std::uint32_t, 3> corner : primitive_.triangles) {
            if (is_mirrored) std::swap(corner[1], corner[2]);
            const glm::uvec3 of(corner[0], corner[1], corner[2]);
            TriangleDescription triangle{.vertex = first_vertex_ + of, .material = material};
            if (!has_area(to_.positions[triangle.vertex.x], to_.positions[triangle.vertex.y],
                          to_.positions[triangle.vertex.z])) {
                file_.note("triangles without area are removed", primitive_.at);
                continue;
            }
            if (!primitive_.normals.empty()) set_normals(first_normal_ + of, triangle);
            if (!primitive_.uvs.empty()) triangle.uv = first_uv_ + of;
            to_.triangles.push_back(triangle);
        }
    }

private:
    void add_position(const glm::dvec3& position) {
        for (int axis = 0; axis < 3; ++axis) {
            if (!(std::abs(position[axis]) <= kLargestCoordinate)) {
                file_.fail(primitive_.at, fmt::format("expected coordinates up to {} in the world, got {}",
                                                      kLargestCoordinate, position[axis]));
            }
        }
        to_.positions.emplace_back(position);
    }

    /// Mean of the places of the joints of a vertex. [glTF 2.0, section 3.7.3.3]
    glm::dmat4 skin_transform(std::size_t vertex) const {
        glm::dmat4 sum(0.0);
        double total = 0.0;
        for (std::size_t k = 4 * vertex; k < 4 * vertex + 4; ++k) {
            const auto weight = static_cast<double>(primitive_.weights[k]);
            if (weight != 0.0 && primitive_.joints[k] >= place_.joints.size()) {
                file_.fail(primitive_.at + "/attributes/JOINTS_0",
                           fmt::format("expected joints below {}, got {} at vertex {}", place_.joints.size(),
                                       primitive_.joints[k], vertex));
            }
            if (weight != 0.0) sum += weight * place_.joints[primitive_.joints[k]];
            total += weight;
        }
        return total > 0.0 ? sum / total : glm::dmat4(1.0);
    }

    void set_normals(const glm::uvec3& normal, TriangleDescription& triangle) {
        for (int k = 0; k < 3; ++k) {
            if (to_.normals[normal[k]] == glm::vec3(0.0f)) {
                file_.note("normals of no length are ignored", primitive_.at);
                return;
            }
        }
        triangle.normal = normal;
    }

    GltfFile& file_;
    const GltfPrimitive& primitive_;
    const GltfPlace& place_;
    SceneDescription& to_;
    bool is_skinned_;
    std::uint32_t first_vertex_, first_normal_, first_uv_;
};

}  // namespace

void copy_gltf_primitive(GltfFile& file, const GltfPrimitive& primitive, std::uint32_t material,
                         const GltfPlace& place, SceneDescription& to) {
    PrimitiveCopier copier(file, primitive, place, to);
    copier.add_vertices();
    copier.add_triangles(material);
}

}  // namespace pl
