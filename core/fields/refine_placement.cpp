#include "core/fields/refine_placement.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "core/fields/disagreement.h"

namespace pl {
namespace {

/// Points that a cell of mean size is known by.
constexpr std::uint32_t kPointsPerVolume = 64;
/// Of these, as many are tried as places of the new volume.
constexpr std::size_t kMostTried = 64;

constexpr std::uint32_t kNotSplit = 0xffffffffu;

/// For each of `split`, points of the surfaces that it serves, evenly by area.
std::vector<std::vector<SurfacePoint>> cells_of(const HostScene& scene, const FieldSettings& settings,
                                                const TableField& field, std::span<const std::uint32_t> split) {
    std::vector<std::uint32_t> entry(field.sites.count, kNotSplit);
    for (std::uint32_t i = 0; i < split.size(); ++i) entry[split[i]] = i;
    std::vector<std::vector<SurfacePoint>> cells(split.size());
    for_each_site(scene, settings, kPointsPerVolume, [&](const SurfacePoint& point) {
        const std::int32_t volume = field.volume_at(point);
        if (volume == kNoVolume) return;
        const std::uint32_t i = entry[static_cast<std::uint32_t>(volume)];
        if (i != kNotSplit) cells[i].push_back(point);
    });
    return cells;
}

/// The point that leaves the cell's points closest to it or to the site, by the sum of squared distances; the first of
/// several. None if no point helps, such as when all are where the site is.
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

/// Behind each volume's rows, those of its child are added, copies of its own.
template <class Array>
void append_copies(Array& array, std::size_t volumes, std::span<const std::uint32_t> parents) {
    const std::size_t row = array.size() / volumes;
    array.resize(array.size() + parents.size() * row);
    for (std::size_t i = 0; i < parents.size(); ++i)
        std::copy_n(array.data() + parents[i] * row, row, array.data() + (volumes + i) * row);
}

/// Divides the records of a cell. An odd one goes to the child in every second cell of a checkerboard, so that cells
/// with one record each leave both with a coarser picture of the whole hemisphere.
void divide_cell(HostTables& tables, std::size_t parent, std::size_t child, bool odd_to_child) {
    const std::uint32_t visits = tables.visits[parent];
    tables.visits[child] = visits / 2 + (odd_to_child ? visits % 2 : 0);
    tables.visits[parent] = visits - tables.visits[child];
    for (const std::size_t cell : {parent, child})
        if (tables.visits[cell] == 0) tables.radiance[cell] = 0.0f;
    tables.pending_sum[child] = 0;
    tables.pending_count[child] = 0;
}

/// Divides what the BSDF share and the reach rest on.
void divide_volume(HostTables& tables, std::size_t parent, std::size_t child) {
    for (LargeArray<float>* sums :
         {&tables.mixture_target, &tables.mixture_weight, &tables.reach_distance, &tables.reach_weight})
        (*sums)[parent] = (*sums)[child] = 0.5f * (*sums)[parent];
    for (LargeArray<std::int64_t>* pending :
         {&tables.pending_slope, &tables.pending_curvature, &tables.pending_distance, &tables.pending_light})
        (*pending)[child] = 0;
}

}  // namespace

RefinedPlacement refine_placement(const HostScene& scene, const FieldSettings& settings, const TableField& field,
                                  std::size_t most, int threads) {
    const std::vector<std::uint32_t> split = worst_volumes(field, most, threads);
    const std::vector<std::vector<SurfacePoint>> cells = cells_of(scene, settings, field, split);
    RefinedPlacement result;
    HostVolumes& volumes = result.volumes;
    volumes.sites.assign(field.sites.data, field.sites.data + field.sites.count);
    volumes.normals.assign(field.normals.data, field.normals.data + field.normals.count);
    for (std::size_t i = 0; i < split.size(); ++i) {
        const std::optional<SurfacePoint> place = second_center(cells[i], field.sites[split[i]].position);
        if (!place) continue;
        volumes.sites.push_back(*place);
        volumes.normals.push_back(place->geometric_normal);
        result.parents.push_back(split[i]);
    }
    volumes.kd_nodes = build_kd_tree(view_of(std::as_const(volumes.sites)));
    return result;
}

HostTables split_tables(const FieldShape& shape, HostTables tables, std::span<const std::uint32_t> parents) {
    const std::size_t volumes = tables.mean_radiance.size();
    zip(tables, tables, [&](const auto&, auto& array) { append_copies(array, volumes, parents); });
    const auto side = static_cast<std::size_t>(shape.cells.side);
    const std::size_t cells = side * side;
    for (std::size_t i = 0; i < parents.size(); ++i) {
        const std::size_t child = volumes + i;
        for (std::size_t cell = 0; cell < cells; ++cell)
            divide_cell(tables, parents[i] * cells + cell, child * cells + cell,
                        (cell / side + cell % side) % 2 != 0);
        divide_volume(tables, parents[i], child);
    }
    return tables;
}

}  // namespace pl
