#include "cpu/neural_update.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/kernel/guiding/update_volume.h"
#include "cpu/neural_network.h"
#include "cpu/parallel_for.h"

namespace pl {
namespace {

/// Volumes of a step of gradient descent.
constexpr std::uint32_t kBatch = 512;
constexpr std::uint32_t kBatchBlocks = kBatch / kNetworkBlock;
/// Every volume teaches the network about once in an update, within these numbers of steps.
constexpr std::uint32_t kFewestSteps = 4;
constexpr std::uint32_t kMostSteps = 40;

/// Of Adam: the rate of the first steps, and the steps in which it falls by the root of 2.
constexpr double kRate = 0.02;
constexpr double kDecay = 300.0;

/// Light in the cells of one volume, as kernels take it.
struct CellRows {
    explicit CellRows(std::uint32_t columns)
        : visits(columns), radiance(columns), is_cell(columns), values(columns) {}

    std::vector<float> visits, radiance, is_cell;
    std::vector<float> values;
};

bool are_finite(const LargeArray<float>& values) {
    return std::ranges::all_of(values, [](float value) { return std::isfinite(value); });
}

class NetworkUpdate {
public:
    NetworkUpdate(const FieldShape& shape, const HostVolumes& volumes, HostNeural& field, int threads)
        : shape_(shape), volumes_(volumes), field_(field), threads_(threads),
          view_(update_view(shape, static_cast<HostTables&>(field))),
          layout_(static_cast<std::uint32_t>(shape.cells.count())),
          count_(static_cast<std::uint32_t>(volume_count(field))), unit_(mean_of_volumes()) {}

    void run() {
        if (field_.counts[kNetworkIsLost] != 0 || !(unit_ > 0.0f)) return;
        if (!learn() || !sample_by_predictions()) give_up();
    }

private:
    /// Mean of the learned radiance over volumes that know light; 0 if none does.
    float mean_of_volumes() const {
        double sum = 0.0;
        std::uint32_t lit = 0;
        for (std::uint32_t volume = 0; volume < count_; ++volume) {
            const float mean = view_.mean_radiance[volume];
            if (!(mean > 0.0f && mean < kInfinity)) continue;
            sum += static_cast<double>(mean);
            ++lit;
        }
        return lit == 0 ? 0.0f : static_cast<float>(sum / lit);
    }

    NetworkPoint point_of(std::uint32_t volume) const {
        return {(volumes_.sites[volume].position - shape_.corner) / shape_.edge, volumes_.normals[volume]};
    }

    /// Whether all stays finite.
    bool learn() {
        const std::uint32_t steps = std::clamp((count_ + kBatch - 1) / kBatch, kFewestSteps, kMostSteps);
        std::vector<NetworkBlock> blocks(kBatchBlocks, NetworkBlock(layout_.columns));
        std::vector<std::vector<float>> slopes(kBatchBlocks, std::vector<float>(layout_.count - layout_.first));
        for (std::uint32_t step = 0; step < steps; ++step)
            if (!descend(blocks, slopes)) return false;
        return true;
    }

    /// Volume n of an endless sequence that takes each once in turn, neighbors far apart.
    std::uint32_t volume_in_turn(std::uint64_t n) const {
        return static_cast<std::uint32_t>(n % count_ * stride_ % count_);
    }

    std::uint32_t far_stride() const {
        auto stride = static_cast<std::uint32_t>(0.6180339887 * count_);
        while (std::gcd(std::max(stride, 1u), count_) != 1) ++stride;
        return std::max(stride, 1u);
    }

    /// One step, by the next volumes. Whether loss, weights and the state of Adam are finite behind it.
    bool descend(std::vector<NetworkBlock>& blocks, std::vector<std::vector<float>>& slopes) {
        const Network network(best_neural_kernels(), layout_, field_.weights.data());
        const std::uint64_t first = std::uint64_t{field_.counts[kNetworkSteps]} * kBatch;
        const std::uint32_t taken = std::min(kBatch, count_);
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
            for (std::uint32_t block = range.begin; block < range.end; ++block) {
                const auto [begin, length] = part(block);
                losses[block] = teach(network, std::span(batch).subspan(begin, length),
                                      std::span(points).subspan(begin, length), blocks[block]);
                network.propagate(blocks[block], slopes[block].data());
            }
        });
        std::vector<float> all(layout_.count);
        float loss = 0.0f;
        for (std::uint32_t block = 0; block < used; ++block) {
            const auto [begin, length] = part(block);
            network.add_feature_slopes(std::span(points).subspan(begin, length), blocks[block], all.data());
            for (std::size_t i = layout_.first; i < layout_.count; ++i) all[i] += slopes[block][i - layout_.first];
            loss += losses[block];
        }
        if (!std::isfinite(loss)) return false;
        move_weights(all);
        return are_finite(field_.weights) && are_finite(field_.slope_square);
    }

    void move_weights(const std::vector<float>& slopes) {
        const double steps = ++field_.counts[kNetworkSteps];
        const double mean_scale = 1.0 / (1.0 - std::pow(double{kMeanShare}, steps));
        const double rate = kRate / std::sqrt(1.0 + steps / kDecay);
        best_neural_kernels().descend({field_.weights.data(), field_.slope_mean.data(), field_.slope_square.data(),
                                       slopes.data(), layout_.count, static_cast<float>(rate * mean_scale),
                                       static_cast<float>(1.0 / (1.0 - std::pow(double{kSquareShare}, steps)))});
    }

    /// The loss of the volumes of a block, and its slopes into the block.
    float teach(const Network& network, std::span<const std::uint32_t> volumes, std::span<const NetworkPoint> points,
                NetworkBlock& block) const {
        network.predict(points, block);
        std::fill(block.logarithm_slopes.begin(), block.logarithm_slopes.end(), 0.0f);
        CellRows light(layout_.columns);
        float loss = 0.0f;
        for (std::size_t i = 0; i < volumes.size(); ++i)
            loss += best_neural_kernels().slopes(light_of(volumes[i], i, block, light), 1.0f / kBatch,
                                                 block.logarithm_slopes.data() + i * layout_.columns);
        return loss;
    }

    VolumeLight light_of(std::uint32_t volume, std::size_t row, const NetworkBlock& block, CellRows& light) const {
        const auto cells = static_cast<std::uint32_t>(shape_.cells.count());
        const float scale = 1.0f / unit_;
        for (std::uint32_t cell = 0; cell < cells; ++cell) {
            light.visits[cell] = visit_weight<One>(view_.visits[volume * cells + cell]);
            light.radiance[cell] = learned_radiance(view_, volume * cells + cell) * scale;
            light.is_cell[cell] = 1.0f;
        }
        return {light.visits.data(), light.radiance.data(), light.is_cell.data(),
                block.logarithms.data() + row * layout_.columns, layout_.columns};
    }

    /// Whether all predictions are finite.
    bool sample_by_predictions() {
        const Network network(best_neural_kernels(), layout_, field_.weights.data());
        const std::uint32_t chunks = (count_ + kNetworkBlock - 1) / kNetworkBlock;
        std::vector<std::uint8_t> finite(chunks, 1);
        ChunkQueue queue(0, chunks, 1);
        parallel_for(threads_, queue, [&](IndexRange range) {
            NetworkBlock block(layout_.columns);
            CellRows light(layout_.columns);
            for (std::uint32_t chunk = range.begin; chunk < range.end; ++chunk) {
                const std::uint32_t first = chunk * kNetworkBlock;
                const std::uint32_t end = std::min(first + kNetworkBlock, count_);
                std::vector<NetworkPoint> points;
                for (std::uint32_t volume = first; volume < end; ++volume) points.push_back(point_of(volume));
                network.predict(points, block);
                for (std::uint32_t volume = first; volume < end; ++volume)
                    if (!sample_by(light_of(volume, volume - first, block, light), volume, light.values.data()))
                        finite[chunk] = 0;
            }
        });
        return std::ranges::all_of(finite, [](std::uint8_t is_finite) { return is_finite != 0; });
    }

    bool sample_by(const VolumeLight& light, std::uint32_t volume, float* predicted) const {
        const NeuralKernels& kernels = best_neural_kernels();
        if (!kernels.predict(light, predicted)) return false;
        const auto side = static_cast<std::uint32_t>(shape_.cells.side);
        kernels.weigh(light, predicted, side, view_.column_cdf.data + std::size_t{volume} * side * side);
        for (std::uint32_t row = volume * side; row < (volume + 1) * side; ++row)
            view_.row_cdf[row] = sum_of(view_.column_cdf.data + std::size_t{row} * side, shape_.cells.side);
        for (std::uint32_t row = volume * side; row < (volume + 1) * side; ++row) build_row(view_, row);
        build_row_choice(view_, volume);
        return true;
    }

    /// The tables by themselves from now on.
    void give_up() {
        const std::uint32_t steps = field_.counts[kNetworkSteps];
        reset_network(shape_, field_);
        field_.counts[kNetworkSteps] = steps;
        field_.counts[kNetworkIsLost] = 1;
        for (std::uint32_t volume = 0; volume < count_; ++volume) update_volume(view_, volume);
    }

    const FieldShape& shape_;
    const HostVolumes& volumes_;
    HostNeural& field_;
    int threads_;
    TableUpdateView view_;
    NetworkLayout layout_;
    std::uint32_t count_;
    std::uint32_t stride_ = far_stride();
    float unit_;
};

}  // namespace

void update_network(const FieldShape& shape, const HostVolumes& volumes, HostNeural& field, int threads) {
    NetworkUpdate(shape, volumes, field, threads).run();
}

}  // namespace pl
