// Densities over the sphere of directions: their integrals, and their probabilities in equal parts of it.
#pragma once

#include <functional>
#include <vector>

#include "core/kernel/base/equal_area_sphere.h"

namespace pl::test {

inline constexpr int kFine = 512;
inline constexpr int kCells = 16;

/// The integral over the sphere of a density, by the middles of kFine x kFine equal parts.
inline double integral_over_sphere(const std::function<float(Vec3f)>& density) {
    double sum = 0.0;
    for (int row = 0; row < kFine; ++row)
        for (int column = 0; column < kFine; ++column) {
            const Vec2f square = (Vec2f{column, row} + 0.5f) / static_cast<float>(kFine);
            sum += static_cast<double>(density(square_to_sphere(square)));
        }
    return sum / (static_cast<double>(kUniformSpherePdf) * kFine * kFine);
}

/// The part, of kCells x kCells, that a direction is in.
inline std::size_t cell_of(Vec3f wi) {
    const Vec2f square = sphere_to_square(wi);
    return static_cast<std::size_t>(square.x * kCells) * kCells + static_cast<std::size_t>(square.y * kCells);
}

/// Probabilities of the parts, by a density.
inline std::vector<double> cell_probabilities(const std::function<float(Vec3f)>& density) {
    std::vector<double> probabilities(kCells * kCells, 0.0);
    for (int row = 0; row < kFine; ++row)
        for (int column = 0; column < kFine; ++column) {
            const Vec3f wi = square_to_sphere((Vec2f{column, row} + 0.5f) / static_cast<float>(kFine));
            probabilities[cell_of(wi)] +=
                static_cast<double>(density(wi) / kUniformSpherePdf) / (static_cast<double>(kFine) * kFine);
        }
    return probabilities;
}

}  // namespace pl::test
