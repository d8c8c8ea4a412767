#include "core/io/emitting_meshes.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/kept_meshes.h"
#include "core/scene/instances.h"

namespace pl {
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
