// From a description to the arrays that kernels read.
#pragma once

#include "core/kernel/scene/camera.h"
#include "core/scene/description.h"
#include "core/scene/scene_storage.h"

namespace pl {

/// Axis-aligned bounds of all triangles; empty scenes give low > high.
struct Bounds {
    Vec3f low{kInfinity};
    Vec3f high{-kInfinity};

    void add(Vec3f point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    bool empty() const { return !(low.x <= high.x); }
    Vec3f center() const { return 0.5f * (low + high); }
    float diagonal() const { return empty() ? 0.0f : glm::length(high - low); }
};

Bounds bounds_of(const SceneDescription& scene);
Bounds bounds_of(const HostScene& scene);

/// Packs triangles, materials and lights and builds the hierarchy. The description must be valid.
/// Smooth normals are packed only if a triangle has them: triangles without get their geometric normal.
HostScene pack_scene(const SceneDescription& scene);

/// The same bits as pack_scene(), without building anything that depends on triangles alone: that is copied from `packed`,
/// which was packed from a scene of other materials and equal in all else.
HostScene repack_materials(const SceneDescription& scene, const HostScene& packed);

/// Are triangles and hierarchy the same, whatever their materials?
bool same_triangles(const HostScene& a, const HostScene& b);

/// Camera basis for an image of the given shape. `up` along the view direction is replaced by the axis that is
/// farthest from it.
Camera make_camera(const CameraDescription& camera, int width, int height);

}  // namespace pl
