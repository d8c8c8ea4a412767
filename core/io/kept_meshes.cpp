#include "core/io/kept_meshes.h"

#include <utility>

#include "core/io/append_triangles.h"
#include "core/io/triangle_area.h"
#include "core/scene/affine.h"

namespace pl {
namespace {

bool mirrors(const glm::dmat4& to_world) { return glm::determinant(glm::dmat3(to_world)) < 0.0; }

/// Of the mesh that is kept for an orientation, relative to that of the file.
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

}  // namespace pl
