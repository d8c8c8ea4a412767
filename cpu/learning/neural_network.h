// The network of a neural field: its predictions for blocks of volumes, the slopes of its loss by its weights, and gradient descent over
// the volumes in batches of them.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/fields/neural_model.h"
#include "core/fields/placement_storage.h"
#include "core/kernel/base/frame.h"
#include "core/kernel/guiding/network_inputs.h"
#include "core/kernel/guiding/vertex_mixture.h"
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

    /// From block.output_slopes: the slopes by the weights of the layers into `slopes`, from kFirstLayer on, and the
    /// slopes by the inputs into the block. The block comes from the last predict().
    void propagate(NetworkBlock& block, float* slopes) const;

    /// Adds the slopes by the features of the grids at these points.
    void add_feature_slopes(std::span<const NetworkPoint> points, const NetworkBlock& block, float* slopes) const;

private:
    const LaneKernels& kernels_;
    const float* weights_;
    std::vector<float> first_turned_, second_turned_, last_turned_;  ///< the layers, [unit][input]
};

/// Light in the cells of one volume. Arrays: [column], directions in its frame.
struct TaughtLight {
    const float* probability;
    const float *x, *y, *z;
    std::uint32_t columns;
    Vec3f normal;  ///< of the volume, in the frame of the world
};

/// The expected -ln q of the light, q the density of vertex_mixture(), and its slopes times `scale` into slopes[column of the outputs].
///
/// Times the cosine's lobe, exp(k_c (n w - 1)), a lobe of concentration k and mean m has the density exp(b + v w) with v = k m + k_c n,
/// whose integral is exp(b + A(|v|)), A(k) = ln(4 pi sinh(k) / k), and A' is the mean cosine r. So the slope of -ln q by b is the
/// share of the lobe in the mixture minus its responsibility, and the slope by v is the same difference of mean
/// directions, as for every exponential family.   [Bishop 2006, "Pattern Recognition and Machine Learning", 2.4 and
/// 9.3]
float mixture_slopes(const LaneKernels& kernels, const TaughtLight& light, const float* outputs, float scale,
                     float* slopes);

/// Volumes of a step, a multiple of kNetworkBlock; and of Adam: the rate of the first steps, and the steps in which it falls by the
/// root of 2.
struct DescentSettings {
    std::uint32_t batch;
    double rate, decay;
};

/// Gradient descent on the weights. Blocks of volumes are summed in their order: any number of threads and any instruction set give the
/// same bits.
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
