// Gradient descent of the network of a neural field over its volumes, in batches of them.
#pragma once

#include <functional>

#include "core/fields/neural_model.h"
#include "core/fields/placement_storage.h"
#include "cpu/learning/neural_network.h"

namespace pl {

/// Volumes of a step, a multiple of kNetworkBlock; and of Adam: the rate of the first steps, and the steps in which it falls by the
/// root of 2.
struct DescentSettings {
    std::uint32_t batch;
    double rate, decay;
};

/// The same bits for any number of threads and any instruction set: blocks of volumes are summed in their order.
class NetworkDescent {
public:
    /// The loss of the volumes of a block, each by 1 / batch, and its slopes by the outputs of the network, which are in the block and
    /// whose slopes are 0 before. Called by several threads.
    using Teach = std::function<float(std::span<const std::uint32_t> volumes, NetworkBlock& block)>;

    /// Moves the weights of `field` and counts its steps. The arguments outlive it.
    NetworkDescent(const FieldShape& shape, const HostVolumes& volumes, HostNeural& field,
                   const DescentSettings& settings, int threads);

    /// One step, by the next volumes. Whether loss, weights and the state of Adam are finite behind it.
    bool step(const Teach& teach);

    NetworkPoint point_of(std::uint32_t volume) const {
        return {(volumes_.sites[volume].position - shape_.corner) / shape_.edge, volumes_.normals[volume]};
    }

private:
    std::uint32_t volume_in_turn(std::uint64_t n) const;
    void move_weights(const std::vector<float>& slopes);

    const FieldShape& shape_;
    const HostVolumes& volumes_;
    HostNeural& field_;
    DescentSettings settings_;
    int threads_;
    std::uint32_t count_, stride_;
    std::vector<NetworkBlock> blocks_;
    std::vector<std::vector<float>> slopes_;  ///< by the weights of the layers, of each block
};

}  // namespace pl
