// The network of a neural field: the sizes of its grids and layers, and the places of their weights in one array.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace pl {

/// Changes with the sizes below: weights of another layout are refused.
inline constexpr std::uint32_t kNetworkLayoutVersion = 1;

/// Points to a side of the grids of learned features, which are interpolated at the position of a volume; the coarsest first.
///   [Mueller et al. 2022, dense levels]
inline constexpr std::array<std::uint32_t, 3> kGridSides{4, 8, 16};
inline constexpr std::uint32_t kFeatures = 4;  ///< of a point of a grid

/// Inputs: the features of the grids, the positive and the negative parts of the normal's components, a constant 1, and zeros.
inline constexpr std::uint32_t kInputs = 32;
inline constexpr std::uint32_t kNormalInput = static_cast<std::uint32_t>(kGridSides.size()) * kFeatures;
inline constexpr std::uint32_t kConstantInput = kNormalInput + 6;
static_assert(kConstantInput < kInputs);

/// Units of each of the two hidden layers, and the length of their rows: with a constant 1 for the bias, and zeros.
inline constexpr std::uint32_t kHidden = 32;
inline constexpr std::uint32_t kHiddenRow = kHidden + 4;

/// Columns of matrices are multiples of this.
inline constexpr std::uint32_t kColumnBlock = 32;

/// Places of the weights: grids [level][z][y][x][feature], then the layers, [input][unit].
struct NetworkLayout {
    std::uint32_t columns;  ///< of the last layer: the cells of a table, and unused ones
    std::size_t first = 0, second = 0, last = 0;
    std::size_t count = 0;

    constexpr explicit NetworkLayout(std::uint32_t cells)
        : columns((cells + kColumnBlock - 1) / kColumnBlock * kColumnBlock) {
        for (const std::uint32_t side : kGridSides) first += std::size_t{side} * side * side * kFeatures;
        second = first + kInputs * kHidden;
        last = second + kHiddenRow * kHidden;
        count = last + std::size_t{kHiddenRow} * columns;
    }
};

}  // namespace pl
