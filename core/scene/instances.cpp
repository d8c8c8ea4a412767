#include "core/scene/instances.h"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/kernel/scene/instances.h"
#include "core/scene/affine.h"
#include "core/scene/normals.h"

namespace pl {
namespace {

/// Numbers of the copies that the current instance has made.
class CopiedNumbers {
public:
    explicit CopiedNumbers(std::size_t count) : entries_(count) {}

    void start_instance() { ++instance_; }
    /// `copy` makes the copy and returns its number, where the instance has none yet.
    template <class Copy>
    std::uint32_t of(std::uint32_t number, Copy&& copy) {
        Entry& entry = entries_[number];
        if (entry.instance != instance_) entry = {instance_, copy()};
        return entry.number;
    }

private:
    struct Entry {
        std::uint32_t instance = 0;
        std::uint32_t number = 0;
    };
    std::vector<Entry> entries_;
    std::uint32_t instance_ = 0;
};

/// Appends triangles of one scene to another one.
class TriangleCopier {
public:
    TriangleCopier(const SceneDescription& from, SceneDescription& to)
        : from_(from), to_(to), vertices_(from.positions.size()), normals_(from.normals.size()) {}

    /// `place`: of these triangles; nullptr: as they are.
    void add(std::uint32_t first, std::uint32_t count, const InstanceDescription* place) {
        is_placed_ = place != nullptr;
        if (is_placed_) {
            to_world_ = affine_of(place->to_world);
            to_mesh_ = inverse_of(place->to_world);
        }
        vertices_.start_instance();
        normals_.start_instance();
        for (std::uint32_t i = 0; i < count; ++i) {
            TriangleDescription triangle = from_.triangles[first + i];
            for (int corner = 0; corner < 3; ++corner) {
                triangle.vertex[corner] = vertex(triangle.vertex[corner]);
                if (triangle.normal[corner] != TriangleDescription::kNoNormal)
                    triangle.normal[corner] = normal(triangle.normal[corner]);
            }
            to_.triangles.push_back(triangle);
        }
    }

private:
    std::uint32_t vertex(std::uint32_t number) {
        return vertices_.of(number, [&] {
            const glm::vec3& p = from_.positions[number];
            to_.positions.push_back(is_placed_ ? to_world_.point(p) : p);
            if (!from_.vertex_colors.empty()) to_.vertex_colors.push_back(from_.vertex_colors[number]);
            return static_cast<std::uint32_t>(to_.positions.size() - 1);
        });
    }
    std::uint32_t normal(std::uint32_t number) {
        return normals_.of(number, [&] {
            const glm::vec3& n = from_.normals[number];
            to_.normals.push_back(is_placed_ ? unit_or_zero(glm::dvec3(to_mesh_.transposed(n))) : n);
            return static_cast<std::uint32_t>(to_.normals.size() - 1);
        });
    }

    const SceneDescription& from_;
    SceneDescription& to_;
    CopiedNumbers vertices_, normals_;
    Affine to_world_, to_mesh_;
    bool is_placed_ = false;
};

std::string complaint_about_meshes(const SceneDescription& scene) {
    std::uint64_t next = scene.meshes.empty() ? scene.triangles.size() : scene.meshes.front().first_triangle;
    for (const MeshDescription& mesh : scene.meshes) {
        if (mesh.first_triangle != next || mesh.triangle_count == 0)
            return fmt::format("\n  mesh '{}': expected triangles from {} on, got {} from {} on", mesh.name, next,
                               mesh.triangle_count, mesh.first_triangle);
        next += mesh.triangle_count;
    }
    if (next == scene.triangles.size()) return {};
    return fmt::format("\n  expected the triangles of meshes to be the last ones of {}, got {} as the end",
                       scene.triangles.size(), next);
}

std::string complaint_about_emission(const SceneDescription& scene) {
    for (const MeshDescription& mesh : scene.meshes)
        if (const auto material = emitting_material(scene, mesh))
            return fmt::format("\n  mesh '{}': its material '{}' emits light; expected none of instances", mesh.name,
                               scene.materials[*material].name);
    return {};
}

std::string complaint_about_instance(const SceneDescription& scene, std::size_t number) {
    const InstanceDescription& instance = scene.instances[number];
    if (instance.mesh >= scene.meshes.size())
        return fmt::format("\n  instance {}: mesh {} is out of range, there are {}", number, instance.mesh,
                           scene.meshes.size());
    if (!is_usable_transform(instance.to_world))
        return fmt::format(
            "\n  instance {} of mesh '{}': expected a finite transformation that can be inverted and does "
            "not mirror, got another one",
            number, scene.meshes[instance.mesh].name);
    return {};
}

}  // namespace

std::uint32_t direct_triangles(const SceneDescription& scene) {
    if (scene.meshes.empty()) return static_cast<std::uint32_t>(scene.triangles.size());
    return scene.meshes.front().first_triangle;
}

std::uint64_t shown_triangles(const SceneDescription& scene) {
    std::uint64_t count = direct_triangles(scene);
    for (const InstanceDescription& instance : scene.instances) count += scene.meshes[instance.mesh].triangle_count;
    return count;
}

bool is_of_mesh(const SceneDescription& scene, std::uint32_t material) {
    for (std::size_t i = direct_triangles(scene); i < scene.triangles.size(); ++i)
        if (scene.triangles[i].material == material) return true;
    return false;
}

std::optional<std::uint32_t> emitting_material(const SceneDescription& scene, const MeshDescription& mesh) {
    for (std::uint32_t i = 0; i < mesh.triangle_count; ++i) {
        const std::uint32_t material = scene.triangles[mesh.first_triangle + i].material;
        if (material < scene.materials.size() && scene.materials[material].emission != glm::vec3(0.0f))
            return material;
    }
    return std::nullopt;
}

void expand_instances(SceneDescription& scene) {
    if (scene.meshes.empty()) return;
    SceneDescription copied;
    std::swap(copied.positions, scene.positions);
    std::swap(copied.normals, scene.normals);
    std::swap(copied.vertex_colors, scene.vertex_colors);
    std::swap(copied.triangles, scene.triangles);
    TriangleCopier copier(copied, scene);
    copier.add(0, scene.meshes.front().first_triangle, nullptr);
    for (const InstanceDescription& instance : scene.instances) {
        const MeshDescription& mesh = scene.meshes[instance.mesh];
        copier.add(mesh.first_triangle, mesh.triangle_count, &instance);
    }
    scene.meshes.clear();
    scene.instances.clear();
}

std::string complaints_about_instances(const SceneDescription& scene) {
    std::string list = complaint_about_meshes(scene) + complaint_about_emission(scene);
    std::size_t bad = 0;
    std::string first;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const std::string complaint = complaint_about_instance(scene, i);
        if (!complaint.empty() && bad++ == 0) first = complaint;
    }
    list += first;
    if (bad > 1) list += fmt::format(" ({} such)", bad);
    if (bad == 0 && shown_triangles(scene) > kMostShownTriangles)
        list += fmt::format("\n  expected at most {} triangles with those of all instances, got {}",
                            kMostShownTriangles, shown_triangles(scene));
    return list;
}

}  // namespace pl
