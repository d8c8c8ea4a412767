#include "cpu/neural_network.h"

#include <algorithm>

namespace pl {
namespace {

/// Hidden units of their sums, and the constant behind them.
void activate(const NetworkLayout& layout, std::vector<float>& units) {
    for (std::size_t row = 0; row < units.size(); row += layout.hidden_row())
        activate_units(units.data() + row, layout.hidden);
}

/// Slopes by the sums of hidden units, of those by the units.
void activate_slopes(const NetworkLayout& layout, const std::vector<float>& units, std::vector<float>& slopes) {
    for (std::size_t row = 0; row < units.size() / layout.hidden_row(); ++row)
        for (std::size_t i = 0; i < layout.hidden; ++i)
            slopes[row * layout.hidden + i] *= units[row * layout.hidden_row() + i] > 0.0f ? 1.0f : kLeak;
}

/// A layer as [unit][input], of its first `inputs` inputs.
std::vector<float> turned(const float* layer, std::uint32_t inputs, std::uint32_t units) {
    std::vector<float> result(std::size_t{inputs} * units);
    for (std::size_t input = 0; input < inputs; ++input)
        for (std::size_t unit = 0; unit < units; ++unit) result[unit * inputs + input] = layer[input * units + unit];
    return result;
}

}  // namespace

NetworkBlock::NetworkBlock(const NetworkLayout& layout)
    : inputs(kNetworkBlock * kInputs), first(kNetworkBlock * layout.hidden_row()),
      second(kNetworkBlock * layout.hidden_row()), outputs(std::size_t{kNetworkBlock} * layout.columns),
      input_slopes(kNetworkBlock * kInputs), first_slopes(kNetworkBlock * layout.hidden),
      second_slopes(kNetworkBlock * layout.hidden), output_slopes(std::size_t{kNetworkBlock} * layout.columns) {}

Network::Network(const NeuralKernels& kernels, const NetworkLayout& layout, const float* weights)
    : kernels_(kernels), layout_(layout), weights_(weights),
      first_turned_(turned(weights + layout.first, kInputs, layout.hidden)),
      second_turned_(turned(weights + layout.second, layout.hidden, layout.hidden)),
      last_turned_(turned(weights + layout.last, layout.hidden, layout.columns)) {}

void Network::predict(std::span<const NetworkPoint> points, NetworkBlock& block) const {
    const std::uint32_t hidden = layout_.hidden;
    const std::uint32_t row = layout_.hidden_row();
    for (std::size_t i = 0; i < points.size(); ++i)
        fill_inputs(points[i], weights_, block.inputs.data() + i * kInputs);
    kernels_.multiply({block.inputs.data(), kInputs, 1, weights_ + layout_.first, hidden, block.first.data(), row,
                       kNetworkBlock, kInputs, hidden, false});
    activate(layout_, block.first);
    kernels_.multiply({block.first.data(), row, 1, weights_ + layout_.second, hidden, block.second.data(), row,
                       kNetworkBlock, row, hidden, false});
    activate(layout_, block.second);
    kernels_.multiply({block.second.data(), row, 1, weights_ + layout_.last, layout_.columns, block.outputs.data(),
                       layout_.columns, kNetworkBlock, row, layout_.columns, false});
}

void Network::propagate(NetworkBlock& block, float* slopes) const {
    const std::uint32_t hidden = layout_.hidden;
    const std::uint32_t row = layout_.hidden_row();
    const std::uint32_t columns = layout_.columns;
    float* last = slopes + (layout_.last - layout_.first);
    float* second = slopes + (layout_.second - layout_.first);
    kernels_.multiply({block.second.data(), 1, row, block.output_slopes.data(), columns, last, columns, row,
                       kNetworkBlock, columns, false});
    kernels_.multiply({block.output_slopes.data(), columns, 1, last_turned_.data(), hidden,
                       block.second_slopes.data(), hidden, kNetworkBlock, columns, hidden, false});
    activate_slopes(layout_, block.second, block.second_slopes);
    kernels_.multiply({block.first.data(), 1, row, block.second_slopes.data(), hidden, second, hidden, row,
                       kNetworkBlock, hidden, false});
    kernels_.multiply({block.second_slopes.data(), hidden, 1, second_turned_.data(), hidden,
                       block.first_slopes.data(), hidden, kNetworkBlock, hidden, hidden, false});
    activate_slopes(layout_, block.first, block.first_slopes);
    kernels_.multiply({block.inputs.data(), 1, kInputs, block.first_slopes.data(), hidden, slopes, hidden, kInputs,
                       kNetworkBlock, hidden, false});
    kernels_.multiply({block.first_slopes.data(), hidden, 1, first_turned_.data(), kInputs, block.input_slopes.data(),
                       kInputs, kNetworkBlock, hidden, kInputs, false});
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
