// Normals of OBJ faces that are to be smooth and have none.
#pragma once

#include "core/io/obj_mesh.h"

namespace pl {

/// Gives the faces of smoothing groups that have no normals one at each vertex: the mean of the normals of those faces around it,
/// weighted by their angles there, as Blender does. Groups are not told apart, which Blender does not do either; faces without a
/// group stay flat and count nowhere. [Thuermer and Wuethrich 1998]
void smooth_normals(ObjMesh& mesh);

}  // namespace pl
