// Default camera of scenes without one.
#pragma once

#include "core/scene/description.h"

namespace pl {

/// Looks along -z at the center of the triangles' bounds, at the distance where their bounding sphere fits a square
/// picture with angle `fov_deg`; along +z if more front-facing area is visible from there, as in a box that is open
/// on that side. The scene must have a triangle.
CameraDescription frame_camera(const SceneDescription& scene, float fov_deg = 40.0f);

}  // namespace pl
