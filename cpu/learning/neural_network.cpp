#include "cpu/learning/neural_network.h"

#include <algorithm>

namespace pl {
namespace {

/// Hidden units of their sums, and the constant behind them.
void activate(std::vector<float>& units) {
    for (std::size_t row = 0; row < units.size(); row += kHiddenRow) activate_units(units.data() + row, kHiddenUnits);
}

/// Slopes by the sums of hidden units, of those by the units.
void activate_slopes(const std::vector<float>& units, std::vector<float>& slopes) {
    for (std::size_t row = 0; row < kNetworkBlock; ++row)
        for (std::size_t i = 0; i < kHiddenUnits; ++i)
            slopes[row * kHiddenUnits + i] *= units[row * kHiddenRow + i] > 0.0f ? 1.0f : kLeak;
}

/// A layer as [unit][input], of its first `inputs` inputs.
std::vector<float> turned(const float* layer, std::uint32_t inputs, std::uint32_t units) {
    std::vector<float> result(std::size_t{inputs} * units);
    for (std::size_t input = 0; input < inputs; ++input)
        for (std::size_t unit = 0; unit < units; ++unit) result[unit * inputs + input] = layer[input * units + unit];
    return result;
}

}  // namespace

Network::Network(const LaneKernels& kernels, const float* weights)
    : kernels_(kernels), weights_(weights), first_turned_(turned(weights + kFirstLayer, kInputs, kHiddenUnits)),
      second_turned_(turned(weights + kSecondLayer, kHiddenUnits, kHiddenUnits)),
      last_turned_(turned(weights + kLastLayer, kHiddenUnits, kOutputColumns)) {}

void Network::predict(std::span<const NetworkPoint> points, NetworkBlock& block) const {
    for (std::size_t i = 0; i < points.size(); ++i)
        fill_inputs(points[i], weights_, block.inputs.data() + i * kInputs);
    kernels_.multiply({block.inputs.data(), kInputs, 1, weights_ + kFirstLayer, kHiddenUnits, block.first.data(),
                       kHiddenRow, kNetworkBlock, kInputs, kHiddenUnits, false});
    activate(block.first);
    kernels_.multiply({block.first.data(), kHiddenRow, 1, weights_ + kSecondLayer, kHiddenUnits, block.second.data(),
                       kHiddenRow, kNetworkBlock, kHiddenRow, kHiddenUnits, false});
    activate(block.second);
    kernels_.multiply({block.second.data(), kHiddenRow, 1, weights_ + kLastLayer, kOutputColumns,
                       block.outputs.data(), kOutputColumns, kNetworkBlock, kHiddenRow, kOutputColumns, false});
}

void Network::propagate(NetworkBlock& block, float* slopes) const {
    float* last = slopes + (kLastLayer - kFirstLayer);
    float* second = slopes + (kSecondLayer - kFirstLayer);
    kernels_.multiply({block.second.data(), 1, kHiddenRow, block.output_slopes.data(), kOutputColumns, last,
                       kOutputColumns, kHiddenRow, kNetworkBlock, kOutputColumns, false});
    kernels_.multiply({block.output_slopes.data(), kOutputColumns, 1, last_turned_.data(), kHiddenUnits,
                       block.second_slopes.data(), kHiddenUnits, kNetworkBlock, kOutputColumns, kHiddenUnits, false});
    activate_slopes(block.second, block.second_slopes);
    kernels_.multiply({block.first.data(), 1, kHiddenRow, block.second_slopes.data(), kHiddenUnits, second,
                       kHiddenUnits, kHiddenRow, kNetworkBlock, kHiddenUnits, false});
    kernels_.multiply({block.second_slopes.data(), kHiddenUnits, 1, second_turned_.data(), kHiddenUnits,
                       block.first_slopes.data(), kHiddenUnits, kNetworkBlock, kHiddenUnits, kHiddenUnits, false});
    activate_slopes(block.first, block.first_slopes);
    kernels_.multiply({block.inputs.data(), 1, kInputs, block.first_slopes.data(), kHiddenUnits, slopes, kHiddenUnits,
                       kInputs, kNetworkBlock, kHiddenUnits, false});
    kernels_.multiply({block.first_slopes.data(), kHiddenUnits, 1, first_turned_.data(), kInputs,
                       block.input_slopes.data(), kInputs, kNetworkBlock, kHiddenUnits, kInputs, false});
}

void Network::add_feature_slopes(std::span<const NetworkPoint> points, const NetworkBlock& block,
                                 float* slopes) const {
    for (std::size_t i = 0; i < points.size(); ++i) {
        const float* by_input = block.input_slopes.data() + i * kInputs;
        for_each_grid_point(points[i].place, [&](std::size_t place, float weight, std::uint32_t input) {
            for (std::uint32_t k = 0; k < kFeatures; ++k) slopes[place + k] += weight * by_input[input + k];
        });
    }
}

}  // namespace pl
