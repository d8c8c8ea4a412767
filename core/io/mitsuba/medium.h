// Media of Mitsuba as the absorption of glass.
#pragma once

#include <glm/glm.hpp>

#include "core/io/mitsuba/xml_file.h"

namespace pl {

/// Absorption per length inside of glass: that of a `medium` element of the type homogeneous, which scatters nothing. Other media
/// are noted and absorb nothing. [Mitsuba 3 and 0.6, homogeneous]
glm::vec3 mitsuba_absorption(const MitsubaObject& medium);

}  // namespace pl
