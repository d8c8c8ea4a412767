#include "core/fields/refine_placement.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "core/base/parallel.h"

namespace pl {
namespace {

/// Points by which a Voronoi cell of mean size is represented.
constexpr std::uint32_t kPointsPerVolume = 64;
/// Most of these points that are tried as positions of the new volume.
constexpr std::size_t kMostTried = 64;

/// Points that are found, and volumes that are split, in one claim of a thread.
constexpr std::uint32_t kPointChunk = 1024;
constexpr std::uint32_t kSplitChunk = 4;

constexpr std::uint32_t kNotSplit = 0xffffffffu;

/// Points of the Voronoi cell of each of `split`: uniform by area, or by area and by paths, as the volumes are.
std::vector<std::vector<SurfacePoint>> cells_of(const SiteSource& source, const PlacementView& placement,
                                                std::span<const std::uint32_t> split) {
    std::vector<std::uint32_t> entry(placement.sites.count, kNotSplit);
    for (std::uint32_t i = 0; i < split.size(); ++i) entry[split[i]] = i;
    std::vector<SurfacePoint> points;
    for_each_site(source, kPointsPerVolume, [&](const SurfacePoint& point) { points.push_back(point); });
    std::vector<std::int32_t> volumes(points.size());
    for_chunks(static_cast<std::uint32_t>(points.size()), kPointChunk, source.threads, [&](IndexRange range) {
        for (std::uint32_t i = range.begin; i < range.end; ++i) volumes[i] = placement.volume_at(points[i]);
    });
    std::vector<std::vector<SurfacePoint>> cells(split.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (volumes[i] == kNoVolume) continue;
        const std::uint32_t cell = entry[static_cast<std::uint32_t>(volumes[i])];
        if (cell != kNotSplit) cells[cell].push_back(points[i]);
    }
    return cells;
}

/// The point with the least sum of squared distances of the cell's points to the nearer of it and the site; the first of
/// several. None if no point reduces the sum, e.g. if all are at the site.
std::optional<SurfacePoint> second_center(const std::vector<SurfacePoint>& cell, Vec3f site) {
    std::vector<double> to_site;
    for (const SurfacePoint& point : cell) to_site.push_back(squared_distance(point.position, site));
    double least = std::accumulate(to_site.begin(), to_site.end(), 0.0);
    std::optional<SurfacePoint> best;
    const std::size_t step = std::max<std::size_t>(1, cell.size() / kMostTried);
    for (std::size_t i = 0; i < cell.size(); i += step) {
        double sum = 0.0;
        for (std::size_t k = 0; k < cell.size(); ++k) {
            const double distance2 = squared_distance(cell[k].position, cell[i].position);
            sum += std::min(to_site[k], distance2);
        }
        if (!(sum < least)) continue;
        least = sum;
        best = cell[i];
    }
    return best;
}

/// Volumes per chunk of work.
constexpr std::uint32_t kChunk = 16;
/// Volumes compared at least before the bound on the rest is tested.
constexpr std::size_t kLeastBatch = 256;

/// A volume and its score n H^2 V^2.
struct Candidate {
    std::uint32_t volume;
    double bound;        ///< of the score: with H^2 = 1
    double score = 0.0;  ///< after comparison
};

/// The probabilities of a checkerboard of a table's cells.
struct ComparedTable {
    struct Cell {
        Vec3f direction;       ///< unit, of the cell's center in the world
        float inverse_cosine;  ///< cells have equal projected solid angle: density times this is proportional to p
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
    SurfacePoint site;
    site.position = own.position;
    double common = 0.0;
    double total = 0.0;
    for (const ComparedTable::Cell& cell : own.cells) {
        const FieldDensity density = field.density({.volume = other}, site, cell.direction);
        const double q = static_cast<double>(density.pdf_sa) * cell.inverse_cosine;
        common += std::sqrt(cell.probability * q);
        total += q;
    }
    const double norm = std::sqrt(own.total * total);
    return norm > 0.0 ? std::clamp(1.0 - common / norm, 0.0, 1.0) : 1.0;
}

/// Training samples of a volume.
double visits_of(const TableField& field, std::uint32_t volume) {
    const std::uint32_t first = field.cell_index(static_cast<std::int32_t>(volume), 0);
    double visits = 0.0;
    for (int cell = 0; cell < field.cells.count(); ++cell)
        visits += field.visits[first + static_cast<std::uint32_t>(cell)];
    return visits;
}

/// Mean squared Hellinger distance to the neighbors, weighted by their training samples; 0 if there are none.
double disagreement(const TableField& field, std::uint32_t volume, const std::vector<double>& visits) {
    // One more, since the nearest is the volume itself, or one at the same position.
    NearestSeveral<kComparedNeighbors + 1> nearest;
    search_kd_tree(field.tree, field.sites[volume].position, field.normals[volume], nearest);
    const ComparedTable own(field, static_cast<std::int32_t>(volume));
    double sum = 0.0;
    double weights = 0.0;
    for (int i = 0; i < nearest.found; ++i) {
        const auto neighbor = static_cast<std::uint32_t>(nearest.volume[i]);
        if (neighbor == volume || !(visits[neighbor] > 0.0)) continue;
        sum += visits[neighbor] * hellinger2(field, own, nearest.volume[i]);
        weights += visits[neighbor];
    }
    return weights > 0.0 ? sum / weights : 0.0;
}

/// Volumes with a positive bound, in descending order.
std::vector<Candidate> candidates_of(const TableField& field, const std::vector<double>& visits) {
    std::vector<Candidate> candidates;
    for (std::uint32_t i = 0; i < visits.size(); ++i) {
        const double mean = field.mean_radiance[i];
        if (const double bound = visits[i] * mean * mean; bound > 0.0) candidates.push_back({i, bound});
    }
    std::ranges::sort(candidates, [](const Candidate& a, const Candidate& b) {
        return a.bound != b.bound ? a.bound > b.bound : a.volume < b.volume;
    });
    return candidates;
}

bool is_better_to_split(const Candidate& a, const Candidate& b) {
    return a.score != b.score ? a.score > b.score : a.volume < b.volume;
}

}  // namespace

RefinedPlacement refine_placement(const SiteSource& source, const PlacementView& placement,
                                  std::span<const std::uint32_t> split) {
    const std::vector<std::vector<SurfacePoint>> cells = cells_of(source, placement, split);
    std::vector<std::optional<SurfacePoint>> centers(split.size());
    for_chunks(static_cast<std::uint32_t>(split.size()), kSplitChunk, source.threads, [&](IndexRange range) {
        for (std::uint32_t i = range.begin; i < range.end; ++i)
            centers[i] = second_center(cells[i], placement.sites[split[i]].position);
    });
    RefinedPlacement result;
    HostVolumes& volumes = result.volumes;
    volumes.sites.assign(placement.sites.begin(), placement.sites.end());
    volumes.normals.assign(placement.normals.begin(), placement.normals.end());
    for (std::size_t i = 0; i < split.size(); ++i) {
        if (!centers[i]) continue;
        volumes.sites.push_back(*centers[i]);
        volumes.normals.push_back(centers[i]->geometric_normal);
        result.parents.push_back(split[i]);
    }
    volumes.kd_nodes = build_kd_tree(view_of(std::as_const(volumes.sites)));
    return result;
}

std::vector<std::uint32_t> volumes_to_split(const AnyFieldView& field, std::size_t most, int threads) {
    return visit_field(field, [&](const auto& view) -> std::vector<std::uint32_t> {
        if constexpr (std::derived_from<std::remove_cvref_t<decltype(view)>, TableField>)
            return volumes_to_split(static_cast<const TableField&>(view), most, threads);
        else
            return {};
    });
}

double hellinger2(const TableField& field, std::int32_t volume, std::int32_t other) {
    return hellinger2(field, ComparedTable(field, volume), other);
}

/// Comparing is expensive, so it ends when the bound of the rest is below the score of all that were found.
std::vector<std::uint32_t> volumes_to_split(const TableField& field, std::size_t most, int threads) {
    std::vector<double> visits(field.normals.count);
    for (std::uint32_t i = 0; i < visits.size(); ++i) visits[i] = visits_of(field, i);
    std::vector<Candidate> candidates = candidates_of(field, visits);
    std::vector<Candidate> best;  // so far
    for (std::size_t done = 0; most > 0 && done < candidates.size();) {
        if (best.size() == most && candidates[done].bound < best.back().score) break;
        const std::size_t end = std::min(done + std::max(most, kLeastBatch), candidates.size());
        ChunkQueue queue(static_cast<std::uint32_t>(done), static_cast<std::uint32_t>(end), kChunk);
        run_on_plain_threads(threads, [&](int) {
            for (IndexRange range = queue.claim(); !range.empty(); range = queue.claim())
                for (std::uint32_t i = range.begin; i < range.end; ++i)
                    candidates[i].score = candidates[i].bound * disagreement(field, candidates[i].volume, visits);
        });
        for (; done < end; ++done)
            if (candidates[done].score > 0.0) best.push_back(candidates[done]);
        std::ranges::sort(best, is_better_to_split);
        best.resize(std::min(most, best.size()));
    }
    std::vector<std::uint32_t> numbers;
    for (const Candidate& candidate : best) numbers.push_back(candidate.volume);
    return numbers;
}

}  // namespace pl
