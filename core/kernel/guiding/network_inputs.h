// The inputs of the network of a neural field: learned features of grids around a place, and the normal.
#pragma once

#include "core/kernel/base/math.h"
#include "core/kernel/guiding/network_layout.h"

namespace pl {

/// Where the network is asked. `place` is in the unit cube.
struct NetworkPoint {
    Vec3f place, normal;
};

/// Calls visit(place of the first feature, weight, first input) for the eight points of each grid around a place.
template <class Visit>
PL_HD void for_each_grid_point(const Vec3f& place, Visit&& visit) {
    std::size_t first = 0;
    for (std::uint32_t grid = 0; grid < kGrids; ++grid) {
        const std::uint32_t side = grid_side(grid);
        std::uint32_t low[3];
        float fraction[3];
        for (int axis = 0; axis < 3; ++axis) {
            const float x = clamp_to(place[axis], 0.0f, 1.0f) * static_cast<float>(side - 1);
            const auto below = static_cast<std::uint32_t>(x);
            low[axis] = below < side - 2 ? below : side - 2;
            fraction[axis] = x - static_cast<float>(low[axis]);
        }
        for (std::uint32_t corner = 0; corner < 8; ++corner) {
            float weight = 1.0f;
            std::size_t index = 0;
            for (int axis = 2; axis >= 0; --axis) {
                const std::uint32_t step = corner >> axis & 1u;
                weight *= step != 0 ? fraction[axis] : 1.0f - fraction[axis];
                index = index * side + low[axis] + step;
            }
            visit(first + index * kFeatures, weight, grid * kFeatures);
        }
        first += grid_values(grid);
    }
}

/// inputs: [kInputs].
PL_HD inline void fill_inputs(const NetworkPoint& point, const float* weights, float* inputs) {
    for (std::uint32_t i = 0; i < kInputs; ++i) inputs[i] = 0.0f;
    for_each_grid_point(point.place, [&](std::size_t place, float weight, std::uint32_t input) {
        for (std::uint32_t k = 0; k < kFeatures; ++k) inputs[input + k] += weight * weights[place + k];
    });
    for (int axis = 0; axis < 3; ++axis) {
        inputs[kNormalInput + 2 * axis] = max_of(point.normal[axis], 0.0f);
        inputs[kNormalInput + 2 * axis + 1] = max_of(-point.normal[axis], 0.0f);
    }
    inputs[kConstantInput] = 1.0f;
}

}  // namespace pl
