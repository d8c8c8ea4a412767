// Validation of scene descriptions before packing.
#pragma once

#include "core/scene/description.h"

namespace pl {

/// Throws one Error(Input) that lists every kind of error with its first place and its count: no triangles, indices
/// out of range, non-finite numbers, albedo outside [0, 1], negative emission, parameters of surfaces, textures and
/// far lights out of range, a camera whose eye and target coincide or whose angle is outside (0, 180) degrees.
void validate_scene(const SceneDescription& scene);

/// validate_scene() for a new material in the place of one of a valid scene.
void validate_material(const MaterialDescription& material, std::uint32_t index, const SceneDescription& scene);

/// The camera's up vector, unless it is parallel to the viewing direction; then an axis that is not. Expects a camera
/// that validate_scene() accepts.
glm::vec3 usable_up(const CameraDescription& camera);

}  // namespace pl
