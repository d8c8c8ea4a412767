#include "core/fields/disagreement.h"

#include <algorithm>
#include <cmath>

#include "core/base/work_queue.h"
#include "core/kernel/methods/guided.h"

namespace pl {
namespace {

/// Volumes that a thread takes at a time.
constexpr std::uint32_t kChunk = 16;

double worth_of(const FieldView& field, std::int32_t volume) {
    const auto index = static_cast<std::uint32_t>(volume);
    // One more than is compared, since the nearest is the volume itself, or one at the same place.
    NearestSeveral<kComparedNeighbours + 1> nearest;
    search_kd_tree(field.tree, field.sites[index].position, field.normals[index], nearest);
    double sum = 0.0;
    double weights = 0.0;
    for (int i = 0; i < nearest.found; ++i) {
        if (nearest.volume[i] == volume) continue;
        const double weight = visits_of(field, nearest.volume[i]);
        if (!(weight > 0.0)) continue;
        sum += weight * hellinger2(field, volume, nearest.volume[i]);
        weights += weight;
    }
    const double mean = field.mean_radiance[index];
    return weights > 0.0 ? visits_of(field, volume) * (sum / weights) * mean * mean : 0.0;
}

}  // namespace

double hellinger2(const FieldView& field, std::int32_t volume, std::int32_t other) {
    const GuidedSampling sampling{.field = field};
    const GuidedMixture tables = sampling.mixture_view();
    const DirectionTable own(field, volume);
    const DirectionTable seen_by(field, other);
    const Frame frame = field.frame(volume);
    const auto index = static_cast<std::uint32_t>(volume);
    const GuidedPlace<One> place{.volume = sampling.serving_volume(other),
                                 .position = unpack(field.sites[index].position),
                                 .shading_normal = unpack(field.normals[index])};
    double common = 0.0;
    double total = 0.0;
    for (int cell = 0; cell < field.cells.count(); ++cell) {
        const Vec2f center = field.cells.point_in_cell(cell, {0.5f, 0.5f});
        const Vec3f local = square_to_cosine_hemisphere(center);
        const SeenDirection<One> seen = tables.look(place, unpack(frame.to_world(local)));
        // Cells are even shares of the cosine density.
        const double q = static_cast<double>(table_density(seen_by, seen.table).pdf_sa * seen.steradians) / local.z;
        const double p = own.cell_probability(cell % field.cells.side, cell / field.cells.side);
        common += std::sqrt(p * q);
        total += q;
    }
    return total > 0.0 ? std::clamp(1.0 - common / std::sqrt(total), 0.0, 1.0) : 1.0;
}

double visits_of(const FieldView& field, std::int32_t volume) {
    const std::uint32_t first = field.cell_index(volume, 0);
    double visits = 0.0;
    for (int cell = 0; cell < field.cells.count(); ++cell)
        visits += field.visits[first + static_cast<std::uint32_t>(cell)];
    return visits;
}

std::vector<double> split_worth(const FieldView& field, int threads) {
    const auto count = static_cast<std::uint32_t>(field.volume_count());
    std::vector<double> result(count, 0.0);
    ChunkQueue queue(0, count, kChunk);
    run_on_plain_threads(std::max(threads, 1), [&](int) {
        for (IndexRange range = queue.claim(); !range.empty(); range = queue.claim())
            for (std::uint32_t i = range.begin; i < range.end; ++i)
                result[i] = worth_of(field, static_cast<std::int32_t>(i));
    });
    return result;
}

}  // namespace pl
