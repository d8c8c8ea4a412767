// The network of a neural field: its predictions for blocks of volumes, and the slopes of its loss by its weights.
#pragma once

#include <span>
#include <vector>

#include "core/kernel/guiding/network_inputs.h"
#include "cpu/base/lane_kernels.h"

namespace pl {

/// Volumes that are worked on together.
inline constexpr std::uint32_t kNetworkBlock = 64;

/// Values of all units for a block of volumes, [volume][unit], and in training the slopes of the loss by them.
struct NetworkBlock {
    std::vector<float> inputs = rows(kInputs), first = rows(kHiddenRow), second = rows(kHiddenRow),
                       outputs = rows(kOutputColumns);
    std::vector<float> input_slopes = rows(kInputs), first_slopes = rows(kHiddenUnits),
                       second_slopes = rows(kHiddenUnits), output_slopes = rows(kOutputColumns);

private:
    static std::vector<float> rows(std::uint32_t units) {
        return std::vector<float>(std::size_t{kNetworkBlock} * units);
    }
};

/// A network for one set of weights.
class Network {
public:
    /// Weights as in network_layout.h. `kernels` and `weights` outlive it.
    Network(const LaneKernels& kernels, const float* weights);

    /// Fills the block's units for these points, at most kNetworkBlock of them.
    void predict(std::span<const NetworkPoint> points, NetworkBlock& block) const;

    /// From block.output_slopes: the slopes by the weights of the layers into `slopes`, from kFirstLayer on, and
    /// those by the inputs into the block. The block is that of the last predict().
    void propagate(NetworkBlock& block, float* slopes) const;

    /// Adds the slopes by the features of the grids at these points.
    void add_feature_slopes(std::span<const NetworkPoint> points, const NetworkBlock& block, float* slopes) const;

private:
    const LaneKernels& kernels_;
    const float* weights_;
    std::vector<float> first_turned_, second_turned_, last_turned_;  ///< the layers, [unit][input]
};

}  // namespace pl
