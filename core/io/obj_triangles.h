// The faces of an OBJ file as the triangles of a scene.
#pragma once

#include "core/io/obj.h"
#include "core/io/obj_materials.h"
#include "core/io/obj_mesh.h"

namespace pl {

/// Fills positions, normals, texture points and triangles of the scene, with warnings about faces that cannot be used
/// as they are; and the groups if they are asked for. The same for any number of threads.
void add_obj_triangles(SceneDescription& scene, ObjMesh mesh, const MaterialTable& materials, MeshGroups* groups,
                       int threads);

}  // namespace pl
