// Meshes that a scene shows more than once: their numbers of triangles, and the scene with copies in their place.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/kernel/geometry/ray.h"
#include "core/scene/description.h"

namespace pl {

/// Most triangles with the triangles of every instance: primitives are numbered in 32 bits, of which the last is
/// kNoPrimitive.
inline constexpr std::uint64_t kMostShownTriangles = std::uint64_t{kNoPrimitive} - 1;

/// Number of the triangles that are in the scene directly: the first ones of SceneDescription::triangles.
std::uint32_t direct_triangles(const SceneDescription& scene);

/// Number of the triangles that rays may meet, with the triangles of every instance.
std::uint64_t shown_triangles(const SceneDescription& scene);

/// Whether a material is on a mesh.
bool is_of_mesh(const SceneDescription& scene, std::uint32_t material);

/// The first material of a mesh that emits light, among the materials in range, or nothing.
std::optional<std::uint32_t> emitting_material(const SceneDescription& scene, const MeshDescription& mesh);

/// Replaces instances by copies of their meshes, in their order behind the direct triangles: corners and normals are
/// as kernels compute them, and primitives keep their numbers.
void expand_instances(SceneDescription& scene);

/// The errors of meshes and instances, a line for each kind, which starts with a line break.
std::string complaints_about_instances(const SceneDescription& scene);

}  // namespace pl
