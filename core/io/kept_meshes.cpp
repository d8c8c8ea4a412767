#include "core/io/kept_meshes.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/triangulate.h"
#include "core/scene/affine.h"
#include "core/scene/instances.h"

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

namespace {

bool mirrors(const glm::dmat4& to_world) { return glm::determinant(glm::dmat3(to_world)) < 0.0; }

/// Transformation of the mesh that is kept for an orientation, relative to the mesh of the file.
glm::dmat4 orientation_of(bool is_mirrored) {
    glm::dmat4 orientation(1.0);
    if (is_mirrored) orientation[0].x = -1.0;
    return orientation;
}

/// From the kept mesh to the world. The mirror is its own inverse.
glm::mat4x3 instance_transform(const glm::dmat4& to_world) {
    return {glm::mat4(to_world * orientation_of(mirrors(to_world)))};
}

bool may_be_instance(const MeshOutline& outline, const glm::dmat4& to_world) {
    if (outline.triangles == 0 || outline.emits || !is_usable_transform(instance_transform(to_world))) return false;
    for (int axis = 0; axis < 3; ++axis) {
        double farthest = std::abs(to_world[3][axis]);
        for (int from = 0; from < 3; ++from) farthest += std::abs(to_world[from][axis]) * outline.reach[from];
        if (!(farthest <= kLargestCoordinate)) return false;
    }
    return true;
}

}  // namespace

void KeptMeshes::count(std::uint32_t mesh, const MeshOutline& outline, const glm::dmat4& to_world) {
    if (!may_be_instance(outline, to_world)) return;
    const std::uint64_t places = ++uses_[mesh].places[mirrors(to_world) ? 1 : 0];
    if (places > 1) repeated_triangles_ += (places == 2 ? 2 : 1) * outline.triangles;
}

bool KeptMeshes::is_instance(std::uint32_t mesh, const MeshOutline& outline, const glm::dmat4& to_world) const {
    if (repeated_triangles_ <= most_copied_ || !may_be_instance(outline, to_world)) return false;
    const auto use = uses_.find(mesh);
    return use != uses_.end() && use->second.places[mirrors(to_world) ? 1 : 0] > 1;
}

void KeptMeshes::show(std::uint32_t mesh, const std::string& name, const glm::dmat4& to_world, const AddMesh& add) {
    const bool is_mirrored = mirrors(to_world);
    std::optional<std::uint32_t>& kept = uses_[mesh].kept[is_mirrored ? 1 : 0];
    if (!kept) {
        const auto first = static_cast<std::uint32_t>(stored_.triangles.size());
        add(orientation_of(is_mirrored), stored_);
        const auto count = static_cast<std::uint32_t>(stored_.triangles.size()) - first;
        kept = static_cast<std::uint32_t>(stored_.meshes.size());
        stored_.meshes.push_back({is_mirrored ? name + " (mirrored)" : name, first, count});
    }
    stored_.instances.push_back({*kept, instance_transform(to_world)});
}

void KeptMeshes::move_to(SceneDescription& scene) {
    const auto first = static_cast<std::uint32_t>(scene.triangles.size());
    for (MeshDescription& mesh : stored_.meshes) mesh.first_triangle += first;
    scene.meshes = std::exchange(stored_.meshes, {});
    scene.instances = std::exchange(stored_.instances, {});
    append_triangles(std::exchange(stored_, {}), scene);
}

namespace {

using TriangleList = std::vector<TriangleDescription>;

/// Meshes and instances of a scene in two parts: those that emit, and the others.
struct Part {
    TriangleList triangles{};
    std::vector<MeshDescription> meshes{};
    std::vector<InstanceDescription> instances{};

    std::uint32_t add(const TriangleList& all, MeshDescription mesh) {
        const auto first = all.begin() + mesh.first_triangle;
        mesh.first_triangle = static_cast<std::uint32_t>(triangles.size());
        triangles.insert(triangles.end(), first, first + mesh.triangle_count);
        meshes.push_back(std::move(mesh));
        return static_cast<std::uint32_t>(meshes.size() - 1);
    }
};

/// [emits]. TriangleList of meshes alone.
std::array<Part, 2> parts_of(const SceneDescription& scene) {
    std::array<Part, 2> parts;
    std::vector<std::pair<std::size_t, std::uint32_t>> places;  // [mesh]: its part and its number there
    for (const MeshDescription& mesh : scene.meshes) {
        const std::size_t part = emitting_material(scene, mesh) ? 1 : 0;
        places.emplace_back(part, parts[part].add(scene.triangles, mesh));
    }
    for (const InstanceDescription& instance : scene.instances) {
        const auto& [part, number] = places[instance.mesh];
        parts[part].instances.push_back({number, instance.to_world});
    }
    return parts;
}

/// Copies of the instances of a part, with vertices of their own and the scene's texture coordinates.
SceneDescription copies_of(Part part, const SceneDescription& scene) {
    SceneDescription copies;
    copies.positions = scene.positions;
    copies.vertex_colors = scene.vertex_colors;
    copies.normals = scene.normals;
    copies.triangles = std::move(part.triangles);
    copies.meshes = std::move(part.meshes);
    copies.instances = std::move(part.instances);
    expand_instances(copies);
    return copies;
}

void append_copies(const SceneDescription& copies, SceneDescription& scene) {
    const auto join = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    for (TriangleDescription triangle : copies.triangles) {
        triangle.vertex += static_cast<std::uint32_t>(scene.positions.size());
        for (int k = 0; k < 3; ++k)
            if (triangle.normal[k] != TriangleDescription::kNoNormal)
                triangle.normal[k] += static_cast<std::uint32_t>(scene.normals.size());
        scene.triangles.push_back(triangle);
    }
    join(scene.positions, copies.positions);
    join(scene.vertex_colors, copies.vertex_colors);
    join(scene.normals, copies.normals);
}

}  // namespace

void copy_emitting_meshes(SceneDescription& scene) {
    if (std::none_of(scene.meshes.begin(), scene.meshes.end(),
                     [&](const MeshDescription& mesh) { return emitting_material(scene, mesh).has_value(); }))
        return;
    auto [kept, emitting] = parts_of(scene);
    std::uint64_t copied = scene.triangles.size();
    for (const InstanceDescription& instance : emitting.instances)
        copied += emitting.meshes[instance.mesh].triangle_count;
    if (copied > kMostStoredTriangles)
        throw Error(ErrorKind::Input,
                    fmt::format("{}: expected at most {} triangles with copies of all meshes that "
                                "emit, such as '{}', got {}",
                                scene.source.string(), kMostStoredTriangles, emitting.meshes.front().name, copied));
    scene.triangles.resize(direct_triangles(scene));
    append_copies(copies_of(std::move(emitting), scene), scene);
    const auto first = static_cast<std::uint32_t>(scene.triangles.size());
    for (MeshDescription& mesh : kept.meshes) mesh.first_triangle += first;
    scene.triangles.insert(scene.triangles.end(), kept.triangles.begin(), kept.triangles.end());
    scene.meshes = std::move(kept.meshes);
    scene.instances = std::move(kept.instances);
}

}  // namespace pl
