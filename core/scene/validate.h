// What a scene must fulfill before it is packed and rendered.
#pragma once

#include "core/scene/description.h"

namespace pl {

/// Throws one Error(Input) that lists every kind of complaint, each with its first place and number: no triangles,
/// indices out of range, numbers that are not finite, albedo outside [0, 1], negative light, surfaces, textures and far
/// lights with numbers beyond their ranges, a camera whose eye and target coincide or whose angle is not within (0, 180)
/// degrees.
void validate_scene(const SceneDescription& scene);

/// The same for one material that is to take a place in a valid scene.
void validate_material(const MaterialDescription& material, const SceneDescription& scene);

/// The camera's up vector if it spans a plane with the viewing direction, else the axis that does so best.
/// Expects a camera that validate_scene() accepts.
glm::vec3 usable_up(const CameraDescription& camera);

}  // namespace pl
