// What lane kernels work on in the update of a neural field.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/kernel/guiding/vertex_network.h"

namespace pl {

/// c = a b, or c + a b if it `adds`, each element summed in ascending order of the inner index. Element (row, i) of `a` is
/// a[row * a_row + i * a_inner]; rows of `b` and `c` lie `b_row` and `c_row` apart. `rows` is a multiple of 4, `columns` one of
/// kColumnBlock.
struct MatrixProduct {
    const float* a;
    std::size_t a_row, a_inner;
    const float* b;
    std::size_t b_row;
    float* c;
    std::size_t c_row;
    std::uint32_t rows, inner, columns;
    bool adds;
};

/// The light of one volume in directions of its cells, and the mixture that learns it. Component k has the density exp(offset_k + axis_k
/// w) over directions w, not normalized. Arrays of directions: [column]; those behind the cells have no probability.
struct MixtureLight {
    const float* probability;  ///< of the light; the sum is 1
    const float *x, *y, *z;    ///< of unit directions
    float offset[kVertexLobes];
    float axis[3][kVertexLobes];
    std::uint32_t columns;
};

/// Expectations over the light: of the responsibility of each component, and of that times the direction.
struct MixtureShares {
    float weight[kVertexLobes];
    float direction[3][kVertexLobes];
};

/// Shares of the old in the running means of slopes and their squares.
inline constexpr float kMeanShare = 0.9f;
inline constexpr float kSquareShare = 0.99f;

/// One step of Adam.   [Kingma and Ba 2015]
struct DescentStep {
    float* weights;
    float* slope_mean;
    float* slope_square;
    const float* slopes;
    std::size_t count;
    float rate;          ///< with the correction of both means for their start at 0
    float square_scale;  ///< of the square's
};

}  // namespace pl
