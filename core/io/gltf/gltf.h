// Loader of glTF 2.0 files: .gltf and .glb.
#pragma once

#include <filesystem>

#include "core/io/load_settings.h"
#include "core/io/obj.h"
#include "core/scene/description.h"

namespace pl {

/// Reads the meshes of the scene that the file shows, with materials, images, cameras and the sun; the caller sets name
/// and camera. y is up.
/// - Meshes that are shown more than once, by nodes or EXT_mesh_gpu_instancing, are copied up to a limit of triangles and kept once
///   above it, see KeptMeshes; always copied if `groups` is not null.
/// - Skins are in the pose of the nodes, morph targets and animations at rest.
/// - Materials become the nearest of the renderer's, see docs/materials.md. Content that has no counterpart is told once
///   for each kind, in `warnings`.
/// - A scene far from the origin is moved near it, with a warning.
/// - URIs may only name data and files in the folder of the file or below.
/// Throws Error(Input) with file, line and JSON pointer (.gltf, the JSON of a .glb) or byte (.glb): malformed JSON, indices,
/// counts, ranges or types that break the format, nodes in a circle, compressed meshes, no triangle at all.
SceneDescription load_gltf(const std::filesystem::path& path, MeshGroups* groups,
                           std::uint64_t most_copied_triangles = kMostCopiedTriangles);

}  // namespace pl
