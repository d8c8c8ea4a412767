// Transformations of instances between a description and the kernels.
#pragma once

#include <cmath>

#include <glm/glm.hpp>

#include "core/kernel/scene/instances.h"

namespace pl {

inline Affine affine_of(const glm::dmat4x3& m) {
    Affine affine;
    for (int i = 0; i < 3; ++i) affine.rows[i] = Vec4f{glm::dvec4{m[0][i], m[1][i], m[2][i], m[3][i]}};
    return affine;
}

/// Inverse in double of the transformation's linear part.
inline glm::dmat3 linear_inverse(const glm::mat4x3& m) { return glm::inverse(glm::dmat3(glm::mat3(m))); }

/// The inverse, rounded once.
inline Affine inverse_of(const glm::mat4x3& m) {
    const glm::dmat3 inverse = linear_inverse(m);
    return affine_of(glm::dmat4x3(inverse[0], inverse[1], inverse[2], -(inverse * glm::dvec3(m[3]))));
}

/// Whether a transformation is finite, does not mirror, and has an inverse in the range of float.
inline bool is_usable_transform(const glm::mat4x3& m) {
    const auto is_finite_affine = [](const Affine& affine) {
        bool finite = true;
        for (const Vec4f& row : affine.rows)
            for (int i = 0; i < 4; ++i) finite = finite && std::isfinite(row[i]);
        return finite;
    };
    return glm::determinant(glm::dmat3(glm::mat3(m))) > 0.0 && is_finite_affine(affine_of(m)) &&
           is_finite_affine(inverse_of(m));
}

}  // namespace pl
