#include "cpu/neural_network.h"

#include <algorithm>

namespace pl {
namespace {

/// Slope of a hidden unit below 0.
constexpr float kLeak = 0.1f;

/// Calls visit(place of the first feature, weight, first input) for the eight points of each grid around a place.
template <class Visit>
void for_each_grid_point(const Vec3f& place, Visit&& visit) {
    std::size_t grid = 0;
    std::uint32_t input = 0;
    for (const std::uint32_t side : kGridSides) {
        std::uint32_t low[3];
        float fraction[3];
        for (int axis = 0; axis < 3; ++axis) {
            const float x = clamp_to(place[axis], 0.0f, 1.0f) * static_cast<float>(side - 1);
            low[axis] = std::min(static_cast<std::uint32_t>(x), side - 2);
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
            visit(grid + index * kFeatures, weight, input);
        }
        grid += std::size_t{side} * side * side * kFeatures;
        input += kFeatures;
    }
}

void fill_inputs(const NetworkPoint& point, const float* weights, float* inputs) {
    std::fill_n(inputs, kInputs, 0.0f);
    for_each_grid_point(point.place, [&](std::size_t place, float weight, std::uint32_t input) {
        for (std::uint32_t k = 0; k < kFeatures; ++k) inputs[input + k] += weight * weights[place + k];
    });
    for (int axis = 0; axis < 3; ++axis) {
        inputs[kNormalInput + 2 * axis] = max_of(point.normal[axis], 0.0f);
        inputs[kNormalInput + 2 * axis + 1] = max_of(-point.normal[axis], 0.0f);
    }
    inputs[kConstantInput] = 1.0f;
}

/// Hidden units of their sums, and the constant behind them.
void activate(std::vector<float>& units) {
    for (std::size_t row = 0; row < units.size(); row += kHiddenRow) {
        for (std::size_t i = row; i < row + kHidden; ++i) units[i] = units[i] > 0.0f ? units[i] : kLeak * units[i];
        units[row + kHidden] = 1.0f;
    }
}

/// Slopes by the sums of hidden units, of those by the units.
void activate_slopes(const std::vector<float>& units, std::vector<float>& slopes) {
    for (std::size_t row = 0; row < units.size() / kHiddenRow; ++row)
        for (std::size_t i = 0; i < kHidden; ++i)
            slopes[row * kHidden + i] *= units[row * kHiddenRow + i] > 0.0f ? 1.0f : kLeak;
}

/// A layer as [unit][input], of its first `inputs` inputs.
std::vector<float> turned(const float* layer, std::uint32_t inputs, std::uint32_t units) {
    std::vector<float> result(std::size_t{inputs} * units);
    for (std::size_t input = 0; input < inputs; ++input)
        for (std::size_t unit = 0; unit < units; ++unit) result[unit * inputs + input] = layer[input * units + unit];
    return result;
}

}  // namespace

NetworkBlock::NetworkBlock(std::uint32_t columns)
    : inputs(kNetworkBlock * kInputs), first(kNetworkBlock * kHiddenRow), second(kNetworkBlock * kHiddenRow),
      logarithms(std::size_t{kNetworkBlock} * columns), input_slopes(kNetworkBlock * kInputs),
      first_slopes(kNetworkBlock * kHidden), second_slopes(kNetworkBlock * kHidden),
      logarithm_slopes(std::size_t{kNetworkBlock} * columns) {}

Network::Network(const NeuralKernels& kernels, const NetworkLayout& layout, const float* weights)
    : kernels_(kernels), layout_(layout), weights_(weights),
      first_turned_(turned(weights + layout.first, kInputs, kHidden)),
      second_turned_(turned(weights + layout.second, kHidden, kHidden)),
      last_turned_(turned(weights + layout.last, kHidden, layout.columns)) {}

void Network::predict(std::span<const NetworkPoint> points, NetworkBlock& block) const {
    for (std::size_t i = 0; i < points.size(); ++i)
        fill_inputs(points[i], weights_, block.inputs.data() + i * kInputs);
    kernels_.multiply({block.inputs.data(), kInputs, 1, weights_ + layout_.first, kHidden, block.first.data(),
                       kHiddenRow, kNetworkBlock, kInputs, kHidden, false});
    activate(block.first);
    kernels_.multiply({block.first.data(), kHiddenRow, 1, weights_ + layout_.second, kHidden, block.second.data(),
                       kHiddenRow, kNetworkBlock, kHiddenRow, kHidden, false});
    activate(block.second);
    kernels_.multiply({block.second.data(), kHiddenRow, 1, weights_ + layout_.last, layout_.columns,
                       block.logarithms.data(), layout_.columns, kNetworkBlock, kHiddenRow, layout_.columns, false});
}

void Network::propagate(NetworkBlock& block, float* slopes) const {
    const std::uint32_t columns = layout_.columns;
    float* last = slopes + (layout_.last - layout_.first);
    float* second = slopes + (layout_.second - layout_.first);
    kernels_.multiply({block.second.data(), 1, kHiddenRow, block.logarithm_slopes.data(), columns, last, columns,
                       kHiddenRow, kNetworkBlock, columns, false});
    kernels_.multiply({block.logarithm_slopes.data(), columns, 1, last_turned_.data(), kHidden,
                       block.second_slopes.data(), kHidden, kNetworkBlock, columns, kHidden, false});
    activate_slopes(block.second, block.second_slopes);
    kernels_.multiply({block.first.data(), 1, kHiddenRow, block.second_slopes.data(), kHidden, second, kHidden,
                       kHiddenRow, kNetworkBlock, kHidden, false});
    kernels_.multiply({block.second_slopes.data(), kHidden, 1, second_turned_.data(), kHidden,
                       block.first_slopes.data(), kHidden, kNetworkBlock, kHidden, kHidden, false});
    activate_slopes(block.first, block.first_slopes);
    kernels_.multiply({block.inputs.data(), 1, kInputs, block.first_slopes.data(), kHidden, slopes, kHidden, kInputs,
                       kNetworkBlock, kHidden, false});
    kernels_.multiply({block.first_slopes.data(), kHidden, 1, first_turned_.data(), kInputs,
                       block.input_slopes.data(), kInputs, kNetworkBlock, kHidden, kInputs, false});
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
