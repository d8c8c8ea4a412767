// Whether a triangle is large enough to be one.
#pragma once

#include <limits>

#include <glm/glm.hpp>

namespace pl {

/// Whether a unit normal can be computed in floats: the squared length of the cross product is a normal float.
inline bool has_area(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::dvec3 origin(a);
    const glm::dvec3 n = glm::cross(glm::dvec3(b) - origin, glm::dvec3(c) - origin);
    return glm::dot(n, n) >= static_cast<double>(std::numeric_limits<float>::min());
}

}  // namespace pl
