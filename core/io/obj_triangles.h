// The faces of an OBJ file as the triangles of a scene.
#pragma once

#include "core/io/obj.h"
#include "core/io/obj_mesh.h"

namespace pl {

// Normals of OBJ faces that are to be smooth and have none.

/// Gives the faces of smoothing groups that have no normals one at each vertex: the mean of the normals of those faces around it,
/// weighted by their angles there, as Blender does. Groups are not told apart, which Blender does not do either; faces without a
/// group stay flat and count nowhere. [Thuermer and Wuethrich 1998]
void smooth_normals(ObjMesh& mesh);

/// Fills positions, normals, texture points and triangles of the scene, with warnings about faces that cannot be used
/// as they are; and the groups if they are asked for. The same for any number of threads.
void add_obj_triangles(SceneDescription& scene, ObjMesh mesh, const MaterialTable& materials, MeshGroups* groups,
                       int threads);

}  // namespace pl
