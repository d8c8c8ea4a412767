// The network of neural fields: the sizes of its grids and layers, and the places of its weights in one array.
#pragma once

#include <cstdint>
#include <cstring>

#include "core/kernel/base/platform.h"

namespace pl {

/// Changes with the sizes below: weights of another layout are refused.
inline constexpr std::uint32_t kNetworkLayoutVersion = 1;

/// Points to a side of the grids of learned features, which are interpolated at the position of a vertex; the coarsest first.   [Mueller et al. 2022, dense levels]
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

inline constexpr std::uint32_t kVertexLobes = 8;

/// Outputs, [parameter][lobe]: offsets from the lobes of an untrained network, see vertex_lobe().
enum VertexParameter : std::uint32_t {
    kLobeLogit,  ///< logarithm of its weight
    kLobeX,      ///< of the vector whose direction is its mean
    kLobeY,
    kLobeZ,
    kLobeNarrowness,  ///< logarithm of its concentration
    kVertexParameters
};
inline constexpr std::uint32_t kVertexOutputs = kVertexParameters * kVertexLobes;

/// Units of each of the two hidden layers, and further units in the rows of any hidden layer: a constant 1 for the bias, and zeros.
inline constexpr std::uint32_t kHiddenUnits = 64;
inline constexpr std::uint32_t kBiasUnits = 4;
inline constexpr std::uint32_t kHiddenRow = kHiddenUnits + kBiasUnits;
/// Slope of a hidden unit below 0.
inline constexpr float kLeak = 0.1f;

enum NetworkCount : std::uint32_t {
    kNetworkSteps,    ///< of gradient descent so far
    kNetworkIsLost,   ///< 1: weights or loss were not finite, so that directions are sampled by the cosine; else 0
    kNetworkVersion,  ///< kNetworkLayoutVersion of the weights
    kNetworkCounts,
};

/// Columns of matrices are multiples of this.
inline constexpr std::uint32_t kColumnBlock = 32;
static_assert(kHiddenUnits % kColumnBlock == 0);
/// Columns of the last layer: the outputs, and padding up to a whole block.
inline constexpr std::uint32_t kOutputColumns = (kVertexOutputs + kColumnBlock - 1) / kColumnBlock * kColumnBlock;

/// Places of the weights: grids [level][z][y][x][feature], then the layers, [input][unit].
inline constexpr std::size_t kFirstLayer = grid_values(0) + grid_values(1) + grid_values(2);
static_assert(kGrids == 3);
inline constexpr std::size_t kSecondLayer = kFirstLayer + std::size_t{kInputs} * kHiddenUnits;
inline constexpr std::size_t kLastLayer = kSecondLayer + std::size_t{kHiddenRow} * kHiddenUnits;
inline constexpr std::size_t kNetworkWeights = kLastLayer + std::size_t{kHiddenRow} * kOutputColumns;

PL_INLINE float activated(float sum) { return sum > 0.0f ? sum : kLeak * sum; }

/// Hidden units of their sums, and the constant behind them.
PL_INLINE void activate_units(float* units, std::uint32_t count) {
    for (std::uint32_t i = 0; i < count; ++i) units[i] = activated(units[i]);
    units[count] = 1.0f;
}

}  // namespace pl
