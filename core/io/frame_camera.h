// Default camera of scenes without one.
#pragma once

#include "core/scene/description.h"

namespace pl {

/// Looks at the center of the scene's bounds, level by scene.up, from where a square picture with angle `fov_deg` just
/// holds the scene: no vertex is nearer to an edge than a twentieth of the side. The side that it looks from:
/// - A box that is open on one of its four sides is seen through the opening, straight on, see open_side().
/// - Everything else is seen in three-quarter view: from the front, front_of(), turned by 35 degrees to the right,
///   or from behind or from the left if more front-facing area is visible there. From 20 degrees above the horizon, or
///   40 if the scene is flat.
/// Instances count as boxes around them. The scene must have a triangle.
CameraDescription frame_camera(const SceneDescription& scene, float fov_deg = 40.0f);

}  // namespace pl
