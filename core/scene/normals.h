// Normals of descriptions as kernels have them.
#pragma once

#include <glm/glm.hpp>

namespace pl {

/// Normalizes in double and rounds once; a vector of length 0 stays 0 and does not affect interpolation.
inline glm::vec3 unit_or_zero(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 ? glm::vec3(v / length) : glm::vec3(0.0f);
}

}  // namespace pl
