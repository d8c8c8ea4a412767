#include "core/fields/disagreement.h"

#include <algorithm>
#include <cmath>

#include "core/base/work_queue.h"
#include "core/kernel/methods/guided.h"

namespace pl {
namespace {

/// Volumes that a thread takes at a time.
constexpr std::uint32_t kChunk = 16;
/// Least volumes that are looked at before it is asked whether the rest can matter.
constexpr std::size_t kLeastBatch = 256;

/// A volume, and what it could be worth to split it. [n H^2 V^2]
struct Candidate {
    std::uint32_t volume;
    double most;         ///< with H^2 = 1
    double worth = 0.0;  ///< once it was compared
};

/// A table as it is compared: what it gives the directions of some of its cells.
struct ComparedTable {
    struct Cell {
        Vec3f direction;       ///< unit, of the cell's center in the world
        float inverse_cosine;  ///< cells are even shares of the cosine density: a density times this goes with p
        double probability;
    };
    Vec3f position;
    Vec3f normal;
    std::vector<Cell> cells;
    double total = 0.0;  ///< of the probabilities

    ComparedTable(const TableField& field, std::int32_t volume)
        : position(field.sites[static_cast<std::uint32_t>(volume)].position),
          normal(field.normals[static_cast<std::uint32_t>(volume)]) {
        const DirectionTable table(field, volume);
        const Frame frame = field.frame(volume);
        const int side = field.cells.side;
        for (int row = 0; row < side; ++row)
            for (int column = row % 2; column < side; column += 2) {
                const Vec2f center = field.cells.point_in_cell(row * side + column, {0.5f, 0.5f});
                const Vec3f local = square_to_cosine_hemisphere(center);
                const double probability = table.cell_probability(column, row);
                cells.push_back({frame.to_world(local), 1.0f / local.z, probability});
                total += probability;
            }
    }
};

double hellinger2(const TableField& field, const ComparedTable& own, std::int32_t other) {
    const GuidedSampling sampling{.field = field};
    const GuidedMixture tables = sampling.mixture_view();
    const DirectionTable table(field, other);
    const GuidedPlace<One> place{.volume = sampling.serving_volume(other),
                                 .position = unpack(own.position),
                                 .shading_normal = unpack(own.normal)};
    double common = 0.0;
    double total = 0.0;
    for (const ComparedTable::Cell& cell : own.cells) {
        const SeenDirection<One> seen = tables.look(place, unpack(cell.direction));
        const float pdf_sa = table_density(table, seen.table).pdf_sa * seen.steradians;
        const double q = static_cast<double>(pdf_sa) * cell.inverse_cosine;
        common += std::sqrt(cell.probability * q);
        total += q;
    }
    const double norm = std::sqrt(own.total * total);
    return norm > 0.0 ? std::clamp(1.0 - common / norm, 0.0, 1.0) : 1.0;
}

/// Records of a volume, all its cells together.
double visits_of(const TableField& field, std::uint32_t volume) {
    const std::uint32_t first = field.cell_index(static_cast<std::int32_t>(volume), 0);
    double visits = 0.0;
    for (int cell = 0; cell < field.cells.count(); ++cell)
        visits += field.visits[first + static_cast<std::uint32_t>(cell)];
    return visits;
}

/// Mean squared distance to the neighbours, weighted by what they know; 0 if there are none.
double disagreement(const TableField& field, std::uint32_t volume, const std::vector<double>& visits) {
    // One more than is compared, since the nearest is the volume itself, or one at the same place.
    NearestSeveral<kComparedNeighbours + 1> nearest;
    search_kd_tree(field.tree, field.sites[volume].position, field.normals[volume], nearest);
    const ComparedTable own(field, static_cast<std::int32_t>(volume));
    double sum = 0.0;
    double weights = 0.0;
    for (int i = 0; i < nearest.found; ++i) {
        const auto neighbour = static_cast<std::uint32_t>(nearest.volume[i]);
        if (neighbour == volume || !(visits[neighbour] > 0.0)) continue;
        sum += visits[neighbour] * hellinger2(field, own, nearest.volume[i]);
        weights += visits[neighbour];
    }
    return weights > 0.0 ? sum / weights : 0.0;
}

/// Those that could be worth anything, by how much that is at most.
std::vector<Candidate> candidates_of(const TableField& field, const std::vector<double>& visits) {
    std::vector<Candidate> candidates;
    for (std::uint32_t i = 0; i < visits.size(); ++i) {
        const double mean = field.mean_radiance[i];
        if (const double most = visits[i] * mean * mean; most > 0.0) candidates.push_back({i, most});
    }
    std::ranges::sort(candidates, [](const Candidate& a, const Candidate& b) {
        return a.most != b.most ? a.most > b.most : a.volume < b.volume;
    });
    return candidates;
}

bool is_worse(const Candidate& a, const Candidate& b) {
    return a.worth != b.worth ? a.worth > b.worth : a.volume < b.volume;
}

}  // namespace

double hellinger2(const TableField& field, std::int32_t volume, std::int32_t other) {
    return hellinger2(field, ComparedTable(field, volume), other);
}

/// Comparing takes long, so it ends where none of the rest could be among the worst, whatever its neighbours say.
std::vector<std::uint32_t> worst_volumes(const TableField& field, std::size_t most, int threads) {
    std::vector<double> visits(field.normals.count);
    for (std::uint32_t i = 0; i < visits.size(); ++i) visits[i] = visits_of(field, i);
    std::vector<Candidate> candidates = candidates_of(field, visits);
    std::vector<Candidate> worst;  // so far
    for (std::size_t done = 0; most > 0 && done < candidates.size();) {
        if (worst.size() == most && candidates[done].most < worst.back().worth) break;
        const std::size_t end = std::min(done + std::max(most, kLeastBatch), candidates.size());
        ChunkQueue queue(static_cast<std::uint32_t>(done), static_cast<std::uint32_t>(end), kChunk);
        run_on_plain_threads(std::max(threads, 1), [&](int) {
            for (IndexRange range = queue.claim(); !range.empty(); range = queue.claim())
                for (std::uint32_t i = range.begin; i < range.end; ++i)
                    candidates[i].worth = candidates[i].most * disagreement(field, candidates[i].volume, visits);
        });
        for (; done < end; ++done)
            if (candidates[done].worth > 0.0) worst.push_back(candidates[done]);
        std::ranges::sort(worst, is_worse);
        worst.resize(std::min(most, worst.size()));
    }
    std::vector<std::uint32_t> numbers;
    for (const Candidate& candidate : worst) numbers.push_back(candidate.volume);
    return numbers;
}

}  // namespace pl
