#include "cpu/learning/neural_network.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cpu/base/parallel_for.h"

namespace pl {
namespace {

/// Hidden units of their sums, and the constant behind them.
void activate(std::vector<float>& units) {
    for (std::size_t row = 0; row < units.size(); row += kHiddenRow) activate_units(units.data() + row, kHiddenUnits);
}

/// Slopes by the sums of hidden units, from the slopes by the units.
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

namespace {

/// A lobe of the network, and its product with the cosine.
struct TaughtLobe {
    VmfLobe lobe;
    Vec3f axis;            ///< v
    float offset;          ///< b, without constants
    float log_integral;    ///< b + A(|v|)
    Vec3f mean_direction;  ///< r(|v|) v / |v|
};

TaughtLobe taught_lobe(const float* outputs, Vec3f normal, std::uint32_t k) {
    TaughtLobe taught;
    taught.lobe = vertex_lobe(outputs_of(outputs, k), normal, k);
    const float kappa = taught.lobe.kappa;
    taught.axis = kappa * taught.lobe.mean + kCosineKappa * normal;
    taught.offset = outputs[kLobeLogit * kVertexLobes + k] + std::log(vmf_peak(kappa)) - kappa;
    const float length = glm::length(taught.axis);
    taught.log_integral = taught.offset - std::log(vmf_peak(length)) + length;
    taught.mean_direction = length > 0.0f ? taught.axis * (vmf_mean_cosine(length) / length) : Vec3f{0.0f};
    return taught;
}

/// Slopes by the outputs of one lobe, from the slopes by b and by v.
void lobe_slopes(const TaughtLobe& taught, const float* outputs, Vec3f normal, std::uint32_t k, float by_offset,
                 Vec3f by_axis, float* slopes) {
    const float kappa = taught.lobe.kappa;
    const Vec3f mean = taught.lobe.mean;
    const float along = glm::dot(by_axis, mean);
    const float by_kappa = along - by_offset * vmf_mean_cosine(kappa);
    const float narrowness = kFirstNarrowness + outputs[kLobeNarrowness * kVertexLobes + k];
    const bool is_free = narrowness > kLeastNarrowness && narrowness < kMostNarrowness;
    const float length = max_of(glm::length(vertex_axis(outputs_of(outputs, k).shift, normal, k)), 1.0e-6f);
    const Vec3f across = (kappa / length) * (by_axis - along * mean);
    slopes[kLobeLogit * kVertexLobes + k] = by_offset;
    slopes[kLobeX * kVertexLobes + k] = across.x;
    slopes[kLobeY * kVertexLobes + k] = across.y;
    slopes[kLobeZ * kVertexLobes + k] = across.z;
    // Beyond a bound a lobe may only come back.
    const float by_narrowness = kappa * by_kappa;
    const bool comes_back = narrowness >= kMostNarrowness ? by_narrowness > 0.0f : by_narrowness < 0.0f;
    slopes[kLobeNarrowness * kVertexLobes + k] = is_free || comes_back ? by_narrowness : 0.0f;
}

}  // namespace

float mixture_slopes(const LaneKernels& kernels, const TaughtLight& light, const float* outputs, float scale,
                     float* slopes) {
    const Frame frame = make_frame(light.normal);
    MixtureLight mixture{light.probability, light.x, light.y, light.z, {}, {}, light.columns};
    TaughtLobe lobes[kVertexLobes];
    float largest = -kInfinity;
    for (std::uint32_t k = 0; k < kVertexLobes; ++k) {
        lobes[k] = taught_lobe(outputs, light.normal, k);
        largest = max_of(largest, lobes[k].log_integral);
        const Vec3f local = frame.to_local(lobes[k].axis);
        mixture.offset[k] = lobes[k].offset;
        for (int axis = 0; axis < 3; ++axis) mixture.axis[axis][k] = local[axis];
    }
    MixtureShares shares;
    const float logarithm = kernels.attribute(mixture, shares);
    float integral = 0.0f;
    for (const TaughtLobe& lobe : lobes) integral += std::exp(lobe.log_integral - largest);
    for (std::uint32_t k = 0; k < kVertexLobes; ++k) {
        const float share = std::exp(lobes[k].log_integral - largest) / integral;
        const Vec3f direction{shares.direction[0][k], shares.direction[1][k], shares.direction[2][k]};
        lobe_slopes(lobes[k], outputs, light.normal, k, scale * (share - shares.weight[k]),
                    scale * (share * lobes[k].mean_direction - frame.to_world(direction)), slopes);
    }
    return largest + std::log(integral) - logarithm;
}

namespace {

bool are_finite(const LargeArray<float>& values) {
    return std::ranges::all_of(values, [](float value) { return std::isfinite(value); });
}

/// A stride coprime to `count`, near the golden ratio: steps by it visit every volume once, consecutive ones far apart.
std::uint32_t far_stride(std::uint32_t count) {
    auto stride = static_cast<std::uint32_t>(0.6180339887 * count);
    while (std::gcd(std::max(stride, 1u), count) != 1) ++stride;
    return std::max(stride, 1u);
}

}  // namespace

NetworkDescent::NetworkDescent(const FieldShape& shape, const HostVolumes& volumes, HostNeural& field,
                               const DescentSettings& settings, int threads)
    : shape_(shape), volumes_(volumes), field_(field), settings_(settings), threads_(threads),
      count_(static_cast<std::uint32_t>(volume_count(field))), stride_(far_stride(count_)),
      blocks_(settings.batch / kNetworkBlock),
      slopes_(settings.batch / kNetworkBlock, std::vector<float>(kNetworkWeights - kFirstLayer)) {}

/// Volume n of an endless sequence that takes each once in turn.
std::uint32_t NetworkDescent::volume_in_turn(std::uint64_t n) const {
    return static_cast<std::uint32_t>(n % count_ * stride_ % count_);
}

bool NetworkDescent::step(const Teach& teach) {
    const Network network(best_lane_kernels(), field_.weights.data());
    const std::uint64_t first = std::uint64_t{field_.counts[kNetworkSteps]} * settings_.batch;
    const std::uint32_t taken = std::min(settings_.batch, count_);
    std::vector<std::uint32_t> batch(taken);
    for (std::uint32_t i = 0; i < taken; ++i) batch[i] = volume_in_turn(first + i);
    std::vector<NetworkPoint> points;
    for (const std::uint32_t volume : batch) points.push_back(point_of(volume));
    const std::uint32_t used = (taken + kNetworkBlock - 1) / kNetworkBlock;
    std::vector<float> losses(used);
    const auto part = [&](std::uint32_t block) {
        const std::uint32_t begin = block * kNetworkBlock;
        return std::pair(begin, std::min(begin + kNetworkBlock, taken) - begin);
    };
    ChunkQueue queue(0, used, 1);
    parallel_for(threads_, queue, [&](IndexRange range) {
        for (std::uint32_t i = range.begin; i < range.end; ++i) {
            const auto [begin, length] = part(i);
            NetworkBlock& block = blocks_[i];
            network.predict(std::span(points).subspan(begin, length), block);
            std::fill(block.output_slopes.begin(), block.output_slopes.end(), 0.0f);
            losses[i] = teach(std::span(batch).subspan(begin, length), block);
            network.propagate(block, slopes_[i].data());
        }
    });
    std::vector<float> all(kNetworkWeights);
    float loss = 0.0f;
    for (std::uint32_t block = 0; block < used; ++block) {
        const auto [begin, length] = part(block);
        network.add_feature_slopes(std::span(points).subspan(begin, length), blocks_[block], all.data());
        for (std::size_t i = kFirstLayer; i < kNetworkWeights; ++i) all[i] += slopes_[block][i - kFirstLayer];
        loss += losses[block];
    }
    if (!std::isfinite(loss)) return false;
    move_weights(all);
    return are_finite(field_.weights) && are_finite(field_.slope_square);
}

void NetworkDescent::move_weights(const std::vector<float>& slopes) {
    const double steps = ++field_.counts[kNetworkSteps];
    const double mean_scale = 1.0 / (1.0 - std::pow(double{kMeanShare}, steps));
    const double rate = settings_.rate / std::sqrt(1.0 + steps / settings_.decay);
    best_lane_kernels().descend({field_.weights.data(), field_.slope_mean.data(), field_.slope_square.data(),
                                 slopes.data(), kNetworkWeights, static_cast<float>(rate * mean_scale),
                                 static_cast<float>(1.0 / (1.0 - std::pow(double{kSquareShare}, steps)))});
}

}  // namespace pl
