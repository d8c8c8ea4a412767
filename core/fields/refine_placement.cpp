#include "core/fields/refine_placement.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "core/base/parallel.h"
#include "core/fields/disagreement.h"

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

}  // namespace pl
