#include "cpu/learning/neural_update.h"

#include <algorithm>

#include "cpu/learning/neural_network.h"

namespace pl {
namespace {

constexpr DescentSettings kDescent{.batch = 256, .rate = 0.01, .decay = 300.0};
/// Every volume teaches the network about twice in an update, within these numbers of steps.
constexpr std::uint32_t kFewestSteps = 16;
constexpr std::uint32_t kMostSteps = 40;

/// Training samples of a volume by which its loss counts half as much as the loss of a volume with many.
constexpr float kHalfVisits = 64.0f;

/// Least sum of a table's probabilities above their uniform floor that teaches: of rounding, if all is floor.
constexpr float kLeastKnown = 0.01f;

/// Most steps that the running means of weights look back.
constexpr double kMeanSteps = 16.0;

/// A number in [0, 1) of its own for every index.
float scattered_unit(std::uint64_t i) {
    const std::uint64_t word = (i + 1) * 0x9e3779b97f4a7c15u;
    const std::uint64_t mixed = (word ^ word >> 31) * 0xbf58476d1ce4e5b9u;
    return static_cast<float>((mixed ^ mixed >> 29) >> 40) * 0x1p-24f;
}

/// Directions in the cells of a hemisphere, [column].
struct CellDirections {
    std::vector<float> x, y, z;

    explicit CellDirections(std::size_t columns) : x(columns), y(columns), z(columns) {}

    /// Anywhere in each cell, others in every step: so lobes do not become narrower than cells.
    void scatter(const DirectionCells& cells, std::uint64_t step) {
        for (int cell = 0; cell < cells.count(); ++cell) {
            const std::uint64_t index =
                2 * (step * static_cast<std::uint64_t>(cells.count()) + static_cast<std::uint64_t>(cell));
            const Vec2f u{scattered_unit(index), scattered_unit(index + 1)};
            const Vec3f local = square_to_cosine_hemisphere(cells.point_in_cell(cell, u));
            const auto i = static_cast<std::size_t>(cell);
            x[i] = local.x;
            y[i] = local.y;
            z[i] = local.z;
        }
    }
};

class NetworkUpdate {
public:
    NetworkUpdate(const FieldShape& shape, const HostVolumes& volumes, HostNeural& field, int threads)
        : shape_(shape), volumes_(volumes), field_(field), view_(update_view(shape, static_cast<HostTables&>(field))),
          descent_(shape, volumes, field, kDescent, threads),
          columns_((static_cast<std::uint32_t>(shape.cells.count()) + kColumnBlock - 1) / kColumnBlock *
                   kColumnBlock),
          directions_(columns_) {}

    void run() {
        if (field_.counts[kNetworkIsLost] != 0 || !knows_light()) return;
        const auto count = static_cast<std::uint32_t>(volume_count(field_));
        const std::uint32_t steps = std::clamp(2 * count / kDescent.batch, kFewestSteps, kMostSteps);
        for (std::uint32_t step = 0; step < steps; ++step)
            if (!learn()) return give_up();
    }

private:
    bool knows_light() const {
        return std::ranges::any_of(field_.mean_radiance, [](float mean) { return mean > 0.0f && mean < kInfinity; });
    }

    /// One step. Whether all stays finite.
    bool learn() {
        directions_.scatter(shape_.cells, field_.counts[kNetworkSteps]);
        if (!descent_.step([this](const auto& volumes, NetworkBlock& block) { return teach(volumes, block); }))
            return false;
        const double steps = std::min(static_cast<double>(field_.counts[kNetworkSteps]), kMeanSteps);
        const auto share = static_cast<float>(1.0 / steps);
        for (std::size_t i = 0; i < field_.average.size(); ++i)
            field_.average[i] += share * (field_.weights[i] - field_.average[i]);
        return true;
    }

    float teach(std::span<const std::uint32_t> volumes, NetworkBlock& block) const {
        std::vector<float> probability(columns_);
        float loss = 0.0f;
        for (std::size_t i = 0; i < volumes.size(); ++i) {
            const float weight = confidence_in(volumes[i]) / static_cast<float>(kDescent.batch);
            if (!(weight > 0.0f) || !fill_probabilities(volumes[i], probability.data())) continue;
            const TaughtLight light{
                probability.data(), directions_.x.data(),        directions_.y.data(), directions_.z.data(),
                columns_,           volumes_.normals[volumes[i]]};
            const std::size_t row = i * kOutputColumns;
            loss += weight * mixture_slopes(best_lane_kernels(), light, block.outputs.data() + row, weight,
                                            block.output_slopes.data() + row);
        }
        return loss;
    }

    /// In [0, 1); 0 of a volume that knows no light.
    float confidence_in(std::uint32_t volume) const {
        if (!(view_.mean_radiance[volume] > 0.0f)) return 0.0f;
        const float visits = TableVolumeSummary{view_}.samples(volume);
        return visits / (visits + kHalfVisits);
    }

    /// Probabilities of the table without the uniform floor, since lobes are nowhere 0. False if the table has
    /// nothing but the floor.
    bool fill_probabilities(std::uint32_t volume, float* probability) const {
        const DirectionTable table(view_, static_cast<std::int32_t>(volume));
        const int side = shape_.cells.side;
        const float floor = shape_.uniform_floor / static_cast<float>(side * side);
        float sum = 0.0f;
        for (int row = 0; row < side; ++row)
            for (int column = 0; column < side; ++column) {
                const float above = max_of(table.cell_probability(column, row) - floor, 0.0f);
                probability[row * side + column] = above;
                sum += above;
            }
        if (!(sum > kLeastKnown)) return false;
        for (int cell = 0; cell < side * side; ++cell) probability[cell] /= sum;
        return true;
    }

    /// The cosine alone from now on.
    void give_up() {
        const std::uint32_t steps = field_.counts[kNetworkSteps];
        reset_network(field_);
        field_.counts[kNetworkSteps] = steps;
        field_.counts[kNetworkIsLost] = 1;
    }

    const FieldShape& shape_;
    const HostVolumes& volumes_;
    HostNeural& field_;
    TableUpdateView view_;
    NetworkDescent descent_;
    std::uint32_t columns_;
    CellDirections directions_;
};

}  // namespace

void update_network(const FieldShape& shape, const HostVolumes& volumes, HostNeural& field, int threads) {
    NetworkUpdate(shape, volumes, field, threads).run();
}

}  // namespace pl
