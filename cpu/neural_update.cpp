#include "cpu/neural_update.h"

#include <algorithm>
#include <cmath>

#include "core/kernel/guiding/update_volume.h"
#include "cpu/network_descent.h"
#include "cpu/parallel_for.h"

namespace pl {
namespace {

constexpr DescentSettings kDescent{.batch = 512, .rate = 0.02, .decay = 300.0};
/// Every volume teaches the network about once in an update, within these numbers of steps.
constexpr std::uint32_t kFewestSteps = 4;
constexpr std::uint32_t kMostSteps = 40;

/// Light in the cells of one volume, as kernels take it.
struct CellRows {
    explicit CellRows(std::uint32_t columns)
        : visits(columns), radiance(columns), is_cell(columns), values(columns) {}

    std::vector<float> visits, radiance, is_cell;
    std::vector<float> values;
};

class NetworkUpdate {
public:
    NetworkUpdate(const FieldShape& shape, const HostVolumes& volumes, HostNeural& field, int threads)
        : shape_(shape), field_(field), threads_(threads), view_(update_view(shape, static_cast<HostTables&>(field))),
          layout_(layout_of(shape)), descent_(shape, volumes, layout_, field, kDescent, threads),
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

    /// Whether all stays finite.
    bool learn() {
        const std::uint32_t batches = (count_ + kDescent.batch - 1) / kDescent.batch;
        const std::uint32_t steps = std::clamp(batches, kFewestSteps, kMostSteps);
        for (std::uint32_t step = 0; step < steps; ++step)
            if (!descent_.step([this](const auto& volumes, NetworkBlock& block) { return teach(volumes, block); }))
                return false;
        return true;
    }

    float teach(std::span<const std::uint32_t> volumes, NetworkBlock& block) const {
        CellRows light(layout_.columns);
        float loss = 0.0f;
        for (std::size_t i = 0; i < volumes.size(); ++i)
            loss += best_neural_kernels().slopes(light_of(volumes[i], i, block, light), 1.0f / kDescent.batch,
                                                 block.output_slopes.data() + i * layout_.columns);
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
                block.outputs.data() + row * layout_.columns, layout_.columns};
    }

    /// Whether all predictions are finite.
    bool sample_by_predictions() {
        const Network network(best_neural_kernels(), layout_, field_.weights.data());
        const std::uint32_t chunks = (count_ + kNetworkBlock - 1) / kNetworkBlock;
        std::vector<std::uint8_t> finite(chunks, 1);
        ChunkQueue queue(0, chunks, 1);
        parallel_for(threads_, queue, [&](IndexRange range) {
            NetworkBlock block(layout_);
            CellRows light(layout_.columns);
            for (std::uint32_t chunk = range.begin; chunk < range.end; ++chunk) {
                const std::uint32_t first = chunk * kNetworkBlock;
                const std::uint32_t end = std::min(first + kNetworkBlock, count_);
                std::vector<NetworkPoint> points;
                for (std::uint32_t volume = first; volume < end; ++volume)
                    points.push_back(descent_.point_of(volume));
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
        reset_network(layout_, field_);
        field_.counts[kNetworkSteps] = steps;
        field_.counts[kNetworkIsLost] = 1;
        for (std::uint32_t volume = 0; volume < count_; ++volume) update_volume(view_, volume);
    }

    const FieldShape& shape_;
    HostNeural& field_;
    int threads_;
    TableUpdateView view_;
    NetworkLayout layout_;
    NetworkDescent descent_;
    std::uint32_t count_;
    float unit_;
};

}  // namespace

void update_network(const FieldShape& shape, const HostVolumes& volumes, HostNeural& field, int threads) {
    NetworkUpdate(shape, volumes, field, threads).run();
}

}  // namespace pl
