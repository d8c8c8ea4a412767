// The network that is evaluated at every vertex: from the inputs of network_inputs.h to the parameters of a mixture of lobes. One
// function for floats and for vectors of them: every unit is summed in ascending order of its inputs, so that the width changes no
// bit.   [Dong et al. 2023, "Neural Parametric Mixtures for Path Guiding"]
#pragma once

#include "core/kernel/guiding/network_layout.h"

namespace pl {

/// Outputs that are computed: a multiple of any vector's width.
inline constexpr std::uint32_t kVertexColumns = (kVertexOutputs + 15) / 16 * 16;
static_assert(kVertexColumns <= kOutputColumns);

/// outputs: [kVertexColumns], from inputs: [kInputs].
using VertexEvaluator = void (*)(const float* weights, const float* inputs, float* outputs);

/// kUnits sums over `inputs`, whose weights lie `row` apart from input to input. Real: float, or a vector of floats.
template <class Real, std::uint32_t kUnits>
PL_INLINE void sum_units(const float* inputs, std::uint32_t count, const float* weights, std::uint32_t row,
                         float* units) {
    constexpr std::uint32_t kLanes = sizeof(Real) / sizeof(float);
    constexpr std::uint32_t kAll = kUnits / kLanes;
    constexpr std::uint32_t kVectors = kAll % 8 == 0 ? 8 : (kAll % 6 == 0 ? 6 : kAll);  // as many as registers hold
    static_assert(kUnits % (kVectors * kLanes) == 0 && kVectors <= 8);
    for (std::uint32_t first = 0; first < kUnits; first += kVectors * kLanes) {
        Real sums[kVectors] = {};
        const float* factors = weights + first;
        for (std::uint32_t i = 0; i < count; ++i, factors += row)
            for (std::uint32_t v = 0; v < kVectors; ++v) {
                Real factor;
                std::memcpy(&factor, factors + v * kLanes, sizeof factor);
                sums[v] += inputs[i] * factor;
            }
        std::memcpy(units + first, sums, sizeof sums);
    }
}

template <class Real>
PL_INLINE void evaluate_vertex(const float* weights, const float* inputs, float* outputs) {
    float first[kHiddenUnits + 1], second[kHiddenUnits + 1];
    sum_units<Real, kHiddenUnits>(inputs, kConstantInput + 1, weights + kFirstLayer, kHiddenUnits, first);
    activate_units(first, kHiddenUnits);
    sum_units<Real, kHiddenUnits>(first, kHiddenUnits + 1, weights + kSecondLayer, kHiddenUnits, second);
    activate_units(second, kHiddenUnits);
    sum_units<Real, kVertexColumns>(second, kHiddenUnits + 1, weights + kLastLayer, kOutputColumns, outputs);
}

}  // namespace pl
