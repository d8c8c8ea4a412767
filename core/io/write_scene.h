// Writer of scene files: any scene as JSON, OBJ and images, from which load_scene() reads the same scene.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/description.h"

namespace pl {

// The mesh of a scene as OBJ and MTL text.

/// A name for each material, all different, that OBJ, MTL and JSON text hold as it is: printable characters without '#'
/// and '\', single blanks inside. Names that are such already stay.
std::vector<std::string> material_names(const SceneDescription& scene);

/// Writes FOLDER/STEM.obj and .mtl. With ObjNormals::Unit, load_obj() reads positions, normals, texture points and triangles to
/// the bit, and the materials in their order, of which the MTL file has only the color. Throws Error(Runtime).
void write_mesh(const SceneDescription& scene, const std::vector<std::string>& names,
                const std::filesystem::path& folder, const std::string& stem);

/// The files that write_scene() has written beside the scene file.
struct SceneParts {
    std::filesystem::path folder;
    std::size_t images = 0;  ///< of materials, and the environment map
};

/// Writes PATH, a scene file, and the folder STEM-parts beside it with the mesh, its materials and images. A scene read from them
/// renders to the same bits: mesh, normals, materials, texels, far lights, camera, listed cameras and settings are the same. Knobs are
/// left out, the mesh has their values; a default light is written as the environment map that it is. All is there or
/// nothing: the folder appears when it is complete, the scene file after it.
/// Instances are written as copies, whose primitives and corners are the same. Expects a valid scene. Throws Error(Usage) for a name that
/// does not end with .json or is taken, Error(Input) for a scene of more than kMostStoredTriangles with the triangles
/// of all instances, Error(Runtime) if a file cannot be written.
SceneParts write_scene(const SceneDescription& scene, const std::filesystem::path& path);

}  // namespace pl
