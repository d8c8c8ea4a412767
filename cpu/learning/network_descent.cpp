#include "cpu/learning/network_descent.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cpu/base/parallel_for.h"

namespace pl {
namespace {

bool are_finite(const LargeArray<float>& values) {
    return std::ranges::all_of(values, [](float value) { return std::isfinite(value); });
}

/// By which a sequence takes each of `count` volumes in turn, neighbors far apart.
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
