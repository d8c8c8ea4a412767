// The network of vertex_network.h for several vertices at once, by the lanes of a warp: a lane sums a tile of units by vertices in
// registers, so that it loads 10 numbers for 16 products instead of a weight for each (of 8 vertices). Every unit is summed in the order of
// evaluate_vertex(), which changes no bit.
#pragma once

#include "core/kernel/base/numbers.h"
#include "core/kernel/guiding/vertex_network.h"

namespace pl {

/// kOfTile, the number of vertices: a power of 2; at most 8 to a lane.
template <std::uint32_t kLanes, std::uint32_t kOfTile>
class NetworkTile {
    static constexpr std::uint32_t kLaneVertices = kOfTile < 8 ? kOfTile : 8;
    static constexpr std::uint32_t kUnitLanes = kLanes / (kOfTile / kLaneVertices);
    /// From unit to unit. With 4 numbers more than needed, lanes that store adjacent units use different banks of shared memory.
    static constexpr std::uint32_t kRow = kOfTile > 1 ? kOfTile + 4 : 1;

public:
    static constexpr std::uint32_t kVertices = kOfTile;
    /// Floats of memory that the lanes share, aligned to 16 bytes.
    static constexpr std::uint32_t kMemory = kHiddenUnits * kRow;

    PL_HD NetworkTile(float* memory, std::uint32_t lane)
        : memory_(memory), unit_(lane % kUnitLanes), vertex_(lane / kUnitLanes * kLaneVertices) {}

    /// inputs: [kConstantInput]. Lanes may set the inputs of different vertices at the same time. Without inputs the outputs mean nothing.
    PL_HD void set_inputs(std::uint32_t vertex, const float* inputs) const {
        for (std::uint32_t i = 0; i < kConstantInput; ++i) memory_[i * kRow + vertex] = inputs[i];
    }
    /// Of an output below kVertexOutputs.
    PL_HD float output(std::uint32_t vertex, std::uint32_t number) const { return memory_[number * kRow + vertex]; }

    /// Outputs of all vertices from their inputs. weights: as in network_layout.h. All lanes must call it; they wait for each other in wait().
    template <class Wait>
    PL_HD_INLINED void evaluate(const float* weights, Wait&& wait) const {
        wait();
        compute_layer<kHiddenUnits, true>(kConstantInput, weights + kFirstLayer, kHiddenUnits, wait);
        compute_layer<kHiddenUnits, true>(kHiddenUnits, weights + kSecondLayer, kHiddenUnits, wait);
        compute_layer<kVertexOutputs, false>(kHiddenUnits, weights + kLastLayer, kOutputColumns, wait);
    }

private:
    /// The weighted sums of one lane: its units, which lie kUnitLanes apart, by its vertices.
    template <std::uint32_t kUnits>
    struct Sums {
        static constexpr std::uint32_t kLaneUnits = (kUnits + kUnitLanes - 1) / kUnitLanes;
        static_assert(kLaneUnits * kUnitLanes <= kHiddenUnits, "units beyond the last are computed, too");
        float of[kLaneUnits][kLaneVertices] = {};
    };

    /// Replaces the inputs of a layer by its units. weights: [inputs + 1][columns], the last row for the constant 1.
    template <std::uint32_t kUnits, bool kIsHidden, class Wait>
    PL_HD_INLINED void compute_layer(std::uint32_t inputs, const float* weights, std::uint32_t columns,
                                     Wait&& wait) const {
        Sums<kUnits> sums;
        const float* factors = weights + unit_;
        const float* row = memory_ + vertex_;
        for (std::uint32_t i = 0; i < inputs; ++i, factors += columns, row += kRow) {
            float values[kLaneVertices];
            load_vertices(values, row);
            add_products(sums, factors, values);
        }
        float ones[kLaneVertices];
        for (float& one : ones) one = 1.0f;
        add_products(sums, factors, ones);
        wait();
        for (std::uint32_t u = 0; u < Sums<kUnits>::kLaneUnits; ++u) {
            if constexpr (kIsHidden)
                for (float& sum : sums.of[u]) sum = activated(sum);
            store_vertices(memory_ + (unit_ + u * kUnitLanes) * kRow + vertex_, sums.of[u]);
        }
        wait();
    }

    template <std::uint32_t kUnits>
    static PL_HD_INLINED void add_products(Sums<kUnits>& sums, const float* factors,
                                           const float (&values)[kLaneVertices]) {
        for (std::uint32_t u = 0; u < Sums<kUnits>::kLaneUnits; ++u) {
            const float factor = factors[u * kUnitLanes];
            for (std::uint32_t v = 0; v < kLaneVertices; ++v) sums.of[u][v] += values[v] * factor;
        }
    }

    static PL_HD_INLINED void load_vertices(float (&values)[kLaneVertices], const float* from) {
        if constexpr (kLaneVertices % 4 == 0)
            for (std::uint32_t v = 0; v < kLaneVertices; v += 4) {
                const FourFloats four = load_four(from + v);
                for (std::uint32_t k = 0; k < 4; ++k) values[v + k] = four.v[k];
            }
        else
            for (std::uint32_t v = 0; v < kLaneVertices; ++v) values[v] = from[v];
    }
    static PL_HD_INLINED void store_vertices(float* to, const float (&values)[kLaneVertices]) {
        if constexpr (kLaneVertices % 4 == 0)
            for (std::uint32_t v = 0; v < kLaneVertices; v += 4)
                store_four(to + v, {{values[v], values[v + 1], values[v + 2], values[v + 3]}});
        else
            for (std::uint32_t v = 0; v < kLaneVertices; ++v) to[v] = values[v];
    }

    float* memory_;  ///< [unit][vertex], rows of kRow
    std::uint32_t unit_, vertex_;
};

}  // namespace pl
