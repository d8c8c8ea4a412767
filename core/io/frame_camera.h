// A camera for a scene that brings none.
#pragma once

#include "core/scene/description.h"

namespace pl {

/// Looks along -z at the middle of the triangles' bounds, from far enough that their bounding sphere fits a square
/// picture of `fov_deg`; along +z if from there more surface shows its front, as in a box that is open on that side.
/// The scene has at least one triangle.
CameraDescription frame_camera(const SceneDescription& scene, float fov_deg = 40.0f);

}  // namespace pl
