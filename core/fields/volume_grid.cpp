#include "core/fields/volume_grid.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/base/parallel.h"
#include "core/fields/grid_pieces.h"
#include "core/fields/nearest_sets.h"
#include "core/fields/normal_trees.h"
#include "core/scene/triangle_planes.h"

namespace pl {
namespace {

/// Sides whose set of volumes is longer get a grid.
constexpr std::size_t kMostListedBySide = 6;

/// Edge of a cell, relative to the distance between volumes. Smaller cells need fewer distances and more memory.
constexpr double kCellSize = 0.4;

/// Most cells and list entries of a side: a constant, and a number for each of its volumes.
constexpr std::uint32_t kFreeCells = 16;
constexpr std::uint32_t kCellsPerVolume = 32;
constexpr std::uint32_t kFreeEntries = 24;
constexpr std::uint32_t kEntriesPerVolume = 32;
static_assert(kGridBytesPerVolume == kCellsPerVolume * sizeof(VolumeCell) + kEntriesPerVolume * 4);
static_assert(kGridBytesPerTriangle ==
              2 * (sizeof(VolumePlace) + sizeof(SideGrid) + kFreeCells * sizeof(VolumeCell) + kFreeEntries * 4));

/// Most nodes that a search may visit, for sides without and with volumes of their own.
constexpr int kEffort = 1024;
constexpr int kEffortWithVolumes = 4096;

/// Points at which the distance between volumes is estimated.
constexpr int kProbes = 32;

/// Bound of the distance between a surface point and its triangle, relative to the distance from the origin: 7
/// roundoffs per coordinate, with a margin.
constexpr double kPointError = gamma_bound(16);
/// Bound of the error of the grid's map, on the same scale: 3 products, 3 sums, and the rounded map.
constexpr double kMapError = gamma_bound(32);
/// Least width of a cell, in map errors.
constexpr double kMinCellErrors = 16.0;

constexpr VolumePlace kSearch{VolumePlace::Kind::Search, 0};

/// A triangle with its longest edge along x, from the frame's origin, and the opposite corner at y > 0.
class FramedTriangle {
public:
    explicit FramedTriangle(const TriangleCorners& corners) {
        int first = 0;
        for (int i = 1; i < 3; ++i)
            if (edge(corners, i) > edge(corners, first)) first = i;
        base_ = edge(corners, first);
        const Vec3d cross = corners.cross();
        const double twice_area = glm::length(cross);
        if (!(twice_area > 0.0) || !(base_ > 0.0)) return;
        region_.origin = corners.p[first];
        region_.x_axis = (corners.p[(first + 1) % 3] - region_.origin) / base_;
        region_.normal = cross / twice_area;
        region_.y_axis = glm::cross(region_.normal, region_.x_axis);
        const Vec3d side = corners.p[(first + 2) % 3] - region_.origin;
        tip_ = {glm::dot(side, region_.x_axis), glm::dot(side, region_.y_axis)};
        const double reach = glm::length(corners.reach());
        region_.thickness = kPointError * reach;
        map_error_ = kMapError * reach;
        is_flat_ = tip_.y > 0.0 && reach < static_cast<double>(kMaxCoordinate);
    }

    /// False for triangles without area, or out of the range of float.
    bool is_flat() const { return is_flat_; }
    double base() const { return base_; }
    double height() const { return tip_.y; }
    double map_error() const { return map_error_; }
    double point_error() const { return region_.thickness; }
    const FlatRegion& frame() const { return region_; }
    Vec2d corner(int i) const { return i == 0 ? Vec2d{0.0} : (i == 1 ? Vec2d{base_, 0.0} : tip_); }
    Vec2d low() const { return Vec2d{-point_error()}; }
    Vec2d high() const { return Vec2d{base_, height()} + point_error(); }

    /// The part of a rectangle that may hold points of this triangle.
    FlatRegion part(Vec2d low, Vec2d high) const {
        FlatRegion region = region_;
        region.polygon = Polygon::rectangle(low, high);
        for (int i = 0; i < 3; ++i) {
            const Vec2d along = corner((i + 1) % 3) - corner(i);
            const Vec2d outwards = Vec2d{along.y, -along.x} / glm::length(along);
            region.polygon.clip(outwards, glm::dot(outwards, corner(i)) + point_error());
        }
        return region;
    }

private:
    static double edge(const TriangleCorners& corners, int i) {
        return glm::length(corners.p[(i + 1) % 3] - corners.p[i]);
    }

    FlatRegion region_;
    Vec2d tip_{0.0};
    double base_ = 0.0;
    double map_error_ = 0.0;
    bool is_flat_ = false;
};

/// Contains all points of a triangle as kernels round them.
Ball ball_around(const TriangleCorners& corners) {
    const Vec3f center{(corners.p[0] + corners.p[1] + corners.p[2]) / 3.0};
    double radius2 = 0.0;
    for (const Vec3d& corner : corners.p) {
        const Vec3d away = corner - Vec3d{center};
        radius2 = std::max(radius2, glm::dot(away, away));
    }
    return {center, std::sqrt(radius2) + 2.0 * kPointError * glm::length(corners.reach())};
}

/// Builds the grids of one side after the other. One object per thread.
class SideBuilder {
public:
    /// `own`: number of volumes placed on each side. `places`: the entries of all sides.
    SideBuilder(const HostScene& scene, const HostVolumes& volumes, const LitSurfaces* surfaces,
                Span<const std::uint32_t> own, NormalTrees& trees, std::span<VolumePlace> places)
        : scene_(scene.view()), tree_{view_of(volumes.kd_nodes)}, sites_(view_of(volumes.sites)), surfaces_(surfaces),
          own_(own), sets_(trees), places_(places) {}

    /// Builds both sides of these entries of the hierarchy's triangles, and writes their places. Places of kind Grid
    /// or Cell number the grids and cells of the pieces that are returned.
    GridPieces build(IndexRange entries) {
        pieces_ = {};
        sets_.restart();
        for (std::uint32_t entry = entries.begin; entry < entries.end; ++entry)
            build_triangle(scene_.bvh.triangles[entry].primitive);
        return std::move(pieces_);
    }

private:
    void build_triangle(std::uint32_t primitive) {
        const TriangleCorners corners{scene_.positions, scene_.triangles[primitive]};
        const Ball ball = ball_around(corners);
        for (const bool front : {true, false}) {
            if (surfaces_ != nullptr && !surfaces_->is_lit(primitive, front)) continue;
            const std::uint32_t side = front ? primitive : primitive + scene_.direct_triangles();
            normal_ = (front ? 1.0f : -1.0f) * scene_.planes[primitive].normal;
            const std::optional<std::uint32_t> only = sets_.find_only(ball, normal_);
            places_[side] =
                only ? VolumePlace{VolumePlace::Kind::Node, *only} : place_of(side, FramedTriangle(corners));
            const VolumePlace::Kind kind = places_[side].kind();
            if (kind == VolumePlace::Kind::Cell || kind == VolumePlace::Kind::Grid) pieces_.sides.push_back(side);
        }
    }

    VolumePlace place_of(std::uint32_t side, const FramedTriangle& triangle) {
        if (!triangle.is_flat()) return kSearch;
        sets_.set_effort(own_[side] > 0 ? kEffortWithVolumes : kEffort);
        most_entries_ = pieces_.lists.size() + kFreeEntries + std::size_t{kEntriesPerVolume} * own_[side];
        const NearestSets::Answer answer = sets_.find(triangle.part(triangle.low(), triangle.high()), normal_);
        if (answer == NearestSets::Answer::None) return {VolumePlace::Kind::Node, VolumePlace::kNone};
        if (answer == NearestSets::Answer::GivenUp) return kSearch;
        if (answer == NearestSets::Answer::Few && sets_.nodes().size() <= kMostListedBySide) return side_of_nodes();
        return grid(triangle, kFreeCells + kCellsPerVolume * own_[side]);
    }

    VolumePlace side_of_nodes() {
        if (sets_.nodes().size() == 1) return {VolumePlace::Kind::Node, sets_.nodes().front()};
        pieces_.side_cells.push_back(cell_of_nodes());
        return {VolumePlace::Kind::Cell, static_cast<std::uint32_t>(pieces_.side_cells.size() - 1)};
    }

    VolumeCell cell_of_nodes() {
        const std::vector<std::uint32_t>& nodes = sets_.nodes();
        const std::size_t last = nodes.size() - 1;
        if (last < VolumeCell::kMostNodes && std::ranges::max(nodes) <= VolumeCell::kMaxNode)
            return {nodes[0], nodes[std::min<std::size_t>(1, last)], nodes[last]};
        const auto first = static_cast<std::uint32_t>(pieces_.lists.size());
        if (first + nodes.size() > most_entries_) return {};
        pieces_.lists.insert(pieces_.lists.end(), nodes.begin(), nodes.end());
        pieces_.lists.back() |= kLastOfList;
        return VolumeCell::list(first);
    }

    /// Distance between volumes on a square lattice of the same density in this plane: a disk of the mean squared
    /// distance to the nearest one holds one volume.
    double spacing(const FramedTriangle& triangle) const {
        const FlatRegion& frame = triangle.frame();
        double sum = 0.0;
        for (int i = 0; i < kProbes; ++i) {
            // Powers of the plastic number cover a square evenly; folded, the triangle.   [Roberts 2018]
            double u = std::fmod(0.5 + i * 0.7548776662466927, 1.0);
            double v = std::fmod(0.5 + i * 0.5698402909980532, 1.0);
            if (u + v > 1.0) {
                u = 1.0 - u;
                v = 1.0 - v;
            }
            const Vec2d at = u * triangle.corner(1) + v * triangle.corner(2);
            const Vec3d point = frame.origin + at.x * frame.x_axis + at.y * frame.y_axis;
            Nearest nearest;
            search_kd_tree(tree_, Vec3f{point}, normal_, nearest);
            const Vec3d away = Vec3d{sites_[static_cast<std::uint32_t>(nearest.volume)].position} - point;
            const double height = glm::dot(away, frame.normal);
            sum += std::max(glm::dot(away, away) - height * height, 0.0);
        }
        return std::sqrt(kPi * sum / kProbes);
    }

    /// Edge of a cell such that there are at most `most_cells` cells and the map's error is small against it.
    static double cell_size(Vec2d extent, double wanted, std::uint32_t most_cells, double map_error) {
        double size =
            std::max({wanted, kMinCellErrors * map_error, 1e-3 * std::max(extent.x, extent.y) / most_cells});
        while (std::ceil(extent.x / size) * std::ceil(extent.y / size) > most_cells) size *= 1.05;
        return size;
    }

    VolumePlace grid(const FramedTriangle& triangle, std::uint32_t most_cells) {
        const FlatRegion& frame = triangle.frame();
        const Vec2d low = triangle.low() - triangle.map_error();
        const Vec2d extent = triangle.high() + triangle.map_error() - low;
        const double wanted = cell_size(extent, kCellSize * spacing(triangle), most_cells, triangle.map_error());
        const Vec2d counts = glm::ceil(extent / wanted);
        const Vec2d size = extent / counts;
        const Vec2d start =
            (-low - Vec2d{glm::dot(frame.origin, frame.x_axis), glm::dot(frame.origin, frame.y_axis)}) / size;
        const SideGrid grid{.x_axis = unpack(Vec3f{frame.x_axis / size.x}),
                            .x_start = static_cast<float>(start.x),
                            .y_axis = unpack(Vec3f{frame.y_axis / size.y}),
                            .y_start = static_cast<float>(start.y),
                            .first_cell = static_cast<std::int32_t>(pieces_.cells.size()),
                            .columns = static_cast<std::int32_t>(counts.x),
                            .rows = static_cast<std::int32_t>(counts.y)};
        const Vec2d error{triangle.map_error()};
        for (std::int32_t row = 0; row < grid.rows; ++row)
            for (std::int32_t column = 0; column < grid.columns; ++column) {
                const Vec2d corner = low + Vec2d{column, row} * size;
                pieces_.cells.push_back(cell(triangle.part(corner - error, corner + size + error)));
            }
        pieces_.grids.push_back(grid);
        return {VolumePlace::Kind::Grid, static_cast<std::uint32_t>(pieces_.grids.size() - 1)};
    }

    VolumeCell cell(const FlatRegion& region) {
        if (region.polygon.empty()) return {};  // no point of the triangle is there
        return sets_.find(region, normal_) == NearestSets::Answer::Few ? cell_of_nodes() : VolumeCell{};
    }

    SceneView scene_;
    KdTreeView tree_;
    Span<const SurfacePoint> sites_;
    const LitSurfaces* surfaces_;
    Span<const std::uint32_t> own_;
    NearestSets sets_;
    std::span<VolumePlace> places_;
    GridPieces pieces_;
    Vec3f normal_{0.0f};            ///< of the side under construction
    std::size_t most_entries_ = 0;  ///< of all lists, at the end of this side
};

bool in_range(const HostVolumes& volumes) {
    return std::all_of(volumes.kd_nodes.begin(), volumes.kd_nodes.end(),
                       [](const KdNode& node) { return max_component(absolute(node.position)) < kMaxCoordinate; });
}

/// [side], fronts first.
std::vector<std::uint32_t> count_on_sides(const HostScene& scene, const HostVolumes& volumes) {
    const std::size_t triangles = scene.planes.size();
    std::vector<std::uint32_t> own(2 * triangles);
    for (const SurfacePoint& site : volumes.sites)
        if (site.primitive < triangles) ++own[site.primitive + (site.front ? 0 : triangles)];
    return own;
}

}  // namespace

HostVolumeGrid build_volume_grid(const HostScene& scene, const HostVolumes& volumes, int threads,
                                 const LitSurfaces* surfaces) {
    if (!in_range(volumes)) return {};
    if (threads <= 0) threads = usable_threads();
    const std::vector<std::uint32_t> own = count_on_sides(scene, volumes);
    const auto entries = static_cast<std::uint32_t>(scene.bvh_triangles.size());
    const std::uint32_t chunk = std::clamp(entries / 128u, 1u, 8192u);
    std::vector<GridPieces> pieces((entries + chunk - 1) / chunk);
    std::vector<VolumePlace> places(own.size(), kSearch);
    NormalTrees trees(view_of(volumes.kd_nodes));
    ChunkQueue queue(0, entries, chunk);
    run_on_plain_threads(threads, [&](int) {
        SideBuilder builder(scene, volumes, surfaces, view_of(own), trees, places);
        for (IndexRange range = queue.claim(); !range.empty(); range = queue.claim())
            pieces[range.begin / chunk] = builder.build(range);
    });
    GridJoiner joiner(std::move(places));
    for (const GridPieces& piece : pieces) joiner.add(piece);
    return joiner.take();
}

}  // namespace pl
