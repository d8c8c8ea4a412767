// Scenes far from the origin of their coordinates, such as maps and buildings in the coordinates of a country.
#pragma once

#include <glm/glm.hpp>

#include "core/scene/description.h"

namespace pl {

/// A scene is far along an axis if its middle is so many times its largest extent from the origin: floats, whose steps grow with the
/// coordinate, then hold less than 2^-18 of the extent.
inline constexpr double kFarAway = 64.0;

/// The point near a box that becomes the origin of a scene with these bounds: short as a number, and 0 along axes on which it is not far.
glm::dvec3 far_origin(const glm::dvec3& low, const glm::dvec3& high);

/// The same for a scene as read from an origin of 0, where floats may have left no triangle an area.
glm::dvec3 far_origin(const SceneDescription& scene);

/// Warns of an origin other than 0.
void tell_origin(SceneDescription& scene);

}  // namespace pl
