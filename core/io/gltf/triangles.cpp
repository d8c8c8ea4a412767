#include "core/io/gltf/triangles.h"

#include <cmath>

#include <fmt/format.h>

#include "core/io/gltf/accessors.h"
#include "core/io/obj_check.h"
#include "core/io/triangle_area.h"

namespace pl {
namespace {

constexpr glm::vec3 kWhite(1.0f);

/// Transformation of normals: the inverse transposed without its factor, which may be infinite.
glm::dmat3 normal_transform(const glm::dmat3& m) {
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    return glm::dot(cofactors[0], m[0]) < 0.0 ? -cofactors : cofactors;
}

/// Places in the world of the joints of a skin, relative to those when the mesh was bound to it.
std::vector<glm::dmat4> joint_transforms(GltfFile& file, const GltfNodes& nodes, std::uint32_t skin) {
    const std::string at = fmt::format("/skins/{}", skin);
    std::vector<glm::dmat4> joints;
    for (std::size_t i = 0; i < file.json().array_size(at + "/joints"); ++i)
        joints.push_back(nodes.all[file.required_index(fmt::format("{}/joints/{}", at, i), "nodes")].to_world);
    const std::string bound_at = at + "/inverseBindMatrices";
    if (const auto accessor = file.index(bound_at, "accessors")) {
        const std::vector<float> bound = read_floats(file, *accessor, "MAT4");
        if (bound.size() < 16 * joints.size()) {
            file.fail(bound_at, fmt::format("expected a matrix for each of {} joints, got {}", joints.size(),
                                            bound.size() / 16));
        }
        for (std::size_t i = 0; i < joints.size(); ++i) {
            glm::dmat4 inverse;
            for (std::size_t k = 0; k < 16; ++k)
                inverse[static_cast<int>(k / 4)][static_cast<int>(k % 4)] = static_cast<double>(bound[16 * i + k]);
            joints[i] = joints[i] * inverse;
        }
    }
    return joints;
}

class TriangleAdder {
public:
    TriangleAdder(GltfFile& file, const GltfNodes& nodes, const std::vector<GltfSurface>& surfaces,
                  SceneDescription& scene, MeshGroups* groups)
        : file_(file), nodes_(nodes), surfaces_(surfaces), scene_(scene), groups_(groups), meshes_(file, surfaces) {}

    void run() {
        if (groups_ != nullptr) groups_->names = {""};
        for (const std::uint32_t number : nodes_.shown) {
            const GltfNode& node = nodes_.all[number];
            if (node.mesh) add_mesh(node);
        }
        if (!scene_.vertex_colors.empty()) scene_.vertex_colors.resize(scene_.positions.size(), kWhite);
    }

private:
    void add_mesh(const GltfNode& node) {
        if (groups_ != nullptr) groups_->names.push_back(node.name);
        joints_ = node.skin ? joint_transforms(file_, nodes_, *node.skin) : std::vector<glm::dmat4>{};
        for (const GltfPrimitive& primitive : meshes_.mesh(*node.mesh)) {
            if (scene_.triangles.size() + primitive.triangles.size() > kMostGltfTriangles ||
                scene_.positions.size() + primitive.positions.size() > kMostGltfVertices) {
                file_.fail(primitive.at, fmt::format("expected at most {} triangles in the scene, with all copies of "
                                                     "meshes, got more",
                                                     kMostGltfTriangles));
            }
            add_vertices(primitive, node.to_world);
            add_triangles(primitive);
        }
    }

    void add_vertices(const GltfPrimitive& primitive, const glm::dmat4& to_world) {
        first_vertex_ = static_cast<std::uint32_t>(scene_.positions.size());
        first_normal_ = static_cast<std::uint32_t>(scene_.normals.size());
        first_uv_ = static_cast<std::uint32_t>(scene_.uvs.size());
        const bool is_skinned = !joints_.empty() && !primitive.joints.empty();
        is_mirrored_ = !is_skinned && glm::determinant(glm::dmat3(to_world)) < 0.0;
        glm::dmat3 turn = normal_transform(glm::dmat3(to_world));
        for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
            const glm::dmat4 matrix = is_skinned ? skin_transform(primitive, i) : to_world;
            add_position(primitive, glm::dvec3(matrix * glm::dvec4(glm::dvec3(primitive.positions[i]), 1.0)));
            if (!primitive.normals.empty()) {
                turn = is_skinned ? normal_transform(glm::dmat3(matrix)) : turn;
                const glm::dvec3 normal = turn * glm::dvec3(primitive.normals[i]);
                const double length = glm::length(normal);
                const bool is_usable = length > 0.0 && std::isfinite(length);
                scene_.normals.push_back(is_usable ? glm::vec3(normal / length) : glm::vec3(0.0f));
            }
        }
        scene_.uvs.insert(scene_.uvs.end(), primitive.uvs.begin(), primitive.uvs.end());
        if (primitive.colors.empty()) return;
        scene_.vertex_colors.resize(first_vertex_, kWhite);
        scene_.vertex_colors.insert(scene_.vertex_colors.end(), primitive.colors.begin(), primitive.colors.end());
    }

    void add_position(const GltfPrimitive& primitive, const glm::dvec3& position) {
        for (int axis = 0; axis < 3; ++axis) {
            if (!(std::abs(position[axis]) <= kLargestCoordinate)) {
                file_.fail(primitive.at, fmt::format("expected coordinates up to {} in the world, got {}",
                                                     kLargestCoordinate, position[axis]));
            }
        }
        scene_.positions.emplace_back(position);
    }

    /// Mean of the places of the joints of a vertex. [glTF 2.0, section 3.7.3.3]
    glm::dmat4 skin_transform(const GltfPrimitive& primitive, std::size_t vertex) const {
        glm::dmat4 sum(0.0);
        double total = 0.0;
        for (std::size_t k = 4 * vertex; k < 4 * vertex + 4; ++k) {
            const auto weight = static_cast<double>(primitive.weights[k]);
            if (weight != 0.0 && primitive.joints[k] >= joints_.size()) {
                file_.fail(primitive.at + "/attributes/JOINTS_0",
                           fmt::format("expected joints below {}, got {} at vertex {}", joints_.size(),
                                       primitive.joints[k], vertex));
            }
            if (weight != 0.0) sum += weight * joints_[primitive.joints[k]];
            total += weight;
        }
        return total > 0.0 ? sum / total : glm::dmat4(1.0);
    }

    void add_triangles(const GltfPrimitive& primitive) {
        const GltfSurface& surface = surfaces_[primitive.surface];
        for (std::array<std::uint32_t, 3> corner : primitive.triangles) {
            if (is_mirrored_) std::swap(corner[1], corner[2]);
            const glm::uvec3 of(corner[0], corner[1], corner[2]);
            TriangleDescription triangle{.vertex = first_vertex_ + of, .material = surface.material};
            if (!has_area(scene_.positions[triangle.vertex.x], scene_.positions[triangle.vertex.y],
                          scene_.positions[triangle.vertex.z])) {
                file_.note("triangles without area are removed", primitive.at);
                continue;
            }
            if (!primitive.normals.empty()) set_normals(primitive, first_normal_ + of, triangle);
            if (!primitive.uvs.empty()) triangle.uv = first_uv_ + of;
            add(triangle);
        }
    }

    void set_normals(const GltfPrimitive& primitive, const glm::uvec3& normal, TriangleDescription& triangle) {
        for (int k = 0; k < 3; ++k) {
            if (scene_.normals[normal[k]] == glm::vec3(0.0f)) {
                file_.note("normals of no length are ignored", primitive.at);
                return;
            }
        }
        triangle.normal = normal;
    }

    void add(const TriangleDescription& triangle) {
        scene_.triangles.push_back(triangle);
        if (groups_ != nullptr) groups_->of_triangle.push_back(static_cast<std::uint32_t>(groups_->names.size() - 1));
    }

    GltfFile& file_;
    const GltfNodes& nodes_;
    const std::vector<GltfSurface>& surfaces_;
    SceneDescription& scene_;
    MeshGroups* groups_;
    GltfMeshes meshes_;
    std::vector<glm::dmat4> joints_;  ///< of the node under way; none without a skin
    std::uint32_t first_vertex_ = 0, first_normal_ = 0, first_uv_ = 0;
    bool is_mirrored_ = false;
};

}  // namespace

void add_gltf_triangles(GltfFile& file, const GltfNodes& nodes, const std::vector<GltfSurface>& surfaces,
                        SceneDescription& scene, MeshGroups* groups) {
    TriangleAdder(file, nodes, surfaces, scene, groups).run();
}

}  // namespace pl
