// Building the grids of core/kernel/guiding/volume_grid.h.
#pragma once

#include "core/fields/placement_storage.h"
#include "core/scene/scene_storage.h"

namespace pl {

/// For each side of each triangle, and each cell of the grids on the larger ones, the volumes that can serve a point
/// there: those whose normal agrees with the side's and that are nearest of some point, for points as
/// make_surface_point() rounds them and distances as squared_distance() does, with every rounding bounded. What would
/// take too much (many volumes at one place, triangles without area) is left to the tree. Memory is at most
/// kGridBytesPerVolume for each volume and kGridBytesPerTriangle for each triangle. The same for any number of
/// threads; 0: as many as run at once on this machine.
HostVolumeGrid build_volume_grid(const HostScene& scene, const HostVolumes& volumes, int threads);

inline constexpr std::size_t kGridBytesPerVolume = 384;
inline constexpr std::size_t kGridBytesPerTriangle = 544;

}  // namespace pl
