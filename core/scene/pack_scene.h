// Conversion of a scene description to the arrays of the kernels.
#pragma once

#include "core/kernel/scene/camera.h"
#include "core/scene/bounds.h"
#include "core/scene/description.h"
#include "core/scene/scene_storage.h"

namespace pl {

/// Bounds of all triangles, empty without any. The triangles of an instance are within the box of its transformed
/// mesh's box.
Bounds bounds_of(const SceneDescription& scene);
Bounds bounds_of(const HostScene& scene);

/// Packs a valid description and builds the BVH and the light tree. Smooth normals are packed only if a triangle has
/// them; triangles without then have their geometric normal.
HostScene pack_scene(const SceneDescription& scene);

/// Equal to pack_scene(scene) bit for bit, but copies everything that depends on triangles alone from `packed`, which
/// must come from a scene that differs in materials only.
HostScene repack_materials(const SceneDescription& scene, const HostScene& packed);

/// Whether triangles and hierarchy are equal, regardless of materials.
bool same_triangles(const HostScene& a, const HostScene& b);

/// Camera for an image of this size in pixels. An `up` vector along the viewing direction is replaced by the
/// coordinate axis with the largest angle to it.
Camera make_camera(const CameraDescription& camera, int width, int height);

}  // namespace pl
