// The networks of neural fields: the sizes of their grids and layers, and the places of their weights in one array.
#pragma once

#include <cstdint>
#include <cstring>

#include "core/kernel/base/platform.h"

namespace pl {

/// Changes with the sizes below: weights of another layout are refused.
inline constexpr std::uint32_t kNetworkLayoutVersion = 1;

/// Points to a side of the grids of learned features, which are interpolated at the position of a volume or of a vertex; the coarsest
/// first.   [Mueller et al. 2022, dense levels]
inline constexpr std::uint32_t kGrids = 3;
PL_HD constexpr std::uint32_t grid_side(std::uint32_t grid) { return 4u << grid; }
inline constexpr std::uint32_t kFeatures = 4;  ///< of a point of a grid

/// Features of all points of a grid.
PL_HD constexpr std::size_t grid_values(std::uint32_t grid) {
    return std::size_t{grid_side(grid)} * grid_side(grid) * grid_side(grid) * kFeatures;
}

/// Inputs: the features of the grids, the positive and the negative parts of the normal's components, a constant 1, and zeros.
inline constexpr std::uint32_t kInputs = 32;
inline constexpr std::uint32_t kNormalInput = kGrids * kFeatures;
inline constexpr std::uint32_t kConstantInput = kNormalInput + 6;
static_assert(kConstantInput < kInputs);

/// Units of each of the two hidden layers of a network over volumes, and those that are added to the rows of any hidden layer: a
/// constant 1 for the bias, and zeros.
inline constexpr std::uint32_t kVolumeHidden = 32;
inline constexpr std::uint32_t kBiasUnits = 4;
/// Slope of a hidden unit below 0.
inline constexpr float kLeak = 0.1f;

enum NetworkCount : std::uint32_t {
    kNetworkSteps,    ///< of gradient descent so far
    kNetworkIsLost,   ///< 1: weights or loss were not finite, so that directions are sampled without it; else 0
    kNetworkVersion,  ///< kNetworkLayoutVersion of the weights
    kNetworkCounts,
};

/// Columns of matrices are multiples of this.
inline constexpr std::uint32_t kColumnBlock = 32;

/// Places of the weights: grids [level][z][y][x][feature], then the layers, [input][unit].
struct NetworkLayout {
    std::uint32_t hidden;   ///< units of each of the two hidden layers, a multiple of kColumnBlock
    std::uint32_t columns;  ///< of the last layer: the outputs, and unused ones
    std::size_t first = 0, second = 0, last = 0;
    std::size_t count = 0;

    constexpr explicit NetworkLayout(std::uint32_t outputs, std::uint32_t hidden_units = kVolumeHidden)
        : hidden(hidden_units), columns((outputs + kColumnBlock - 1) / kColumnBlock * kColumnBlock) {
        for (std::uint32_t grid = 0; grid < kGrids; ++grid) first += grid_values(grid);
        second = first + std::size_t{kInputs} * hidden;
        last = second + std::size_t{hidden_row()} * hidden;
        count = last + std::size_t{hidden_row()} * columns;
    }

    constexpr std::uint32_t hidden_row() const { return hidden + kBiasUnits; }
};

PL_INLINE float activated(float sum) { return sum > 0.0f ? sum : kLeak * sum; }

/// Hidden units of their sums, and the constant behind them.
PL_INLINE void activate_units(float* units, std::uint32_t count) {
    for (std::uint32_t i = 0; i < count; ++i) units[i] = activated(units[i]);
    units[count] = 1.0f;
}

}  // namespace pl
