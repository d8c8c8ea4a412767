// The placement of the radiance volumes as kernels read it: positions, normals, and the search structures for the
// volume that serves a point. Shared by all representations that keep one hemisphere per volume.
#pragma once

#include "core/kernel/base/frame.h"
#include "core/kernel/guiding/volume_grid.h"

namespace pl {

struct PlacementView {
    KdTreeView tree;
    VolumeGridView grid;
    Span<const Vec3f> normals;       ///< unit: axis of the volume's hemisphere. [volume]
    Span<const SurfacePoint> sites;  ///< the surface point of each volume. [volume]
    float extent = 0.0f;             ///< unit of distances: the diagonal of the scene's bounds; 0 if unknown

    /// The volume that serves a surface point, or kNoVolume.
    PL_HD std::int32_t volume_at(const SurfacePoint& point) const { return find(point).volume; }
    PL_HD FoundVolume find(const SurfacePoint& point) const { return find_volume(tree, grid, point); }

    PL_HD std::int32_t volume_count() const { return static_cast<std::int32_t>(normals.count); }
    /// World from local: local z is the volume's normal.
    PL_HD Frame frame(std::int32_t volume) const { return make_frame(normals[static_cast<std::uint32_t>(volume)]); }
};

}  // namespace pl
