// Building the grids of core/kernel/guiding/volume_grid.h.
#pragma once

#include "core/fields/placement_storage.h"
#include "core/fields/surfaces.h"
#include "core/scene/scene_storage.h"

namespace pl {

/// For each side of each triangle, and each cell of the grids on the larger sides, the volumes that can serve a point
/// there: those whose normal agrees with the side's and that are nearest to some point, for points as
/// make_surface_point() rounds them and distances as squared_distance() does, with every rounding bounded. Sides and
/// cells whose set takes too long to find or is too long to list (many volumes at one position, triangles without
/// area) are marked for a search of the tree, and so are sides that no light reaches, if `surfaces` are given: paths seldom meet
/// these, and they are nearly half of the sides of closed meshes. Memory is at most kGridBytesPerVolume for each volume and
/// kGridBytesPerTriangle for each triangle. The result does not depend on the number of threads; `threads` 0: as many
/// as run at once on this machine.
HostVolumeGrid build_volume_grid(const HostScene& scene, const HostVolumes& volumes, int threads,
                                 const LitSurfaces* surfaces = nullptr);

inline constexpr std::size_t kGridBytesPerVolume = 384;
inline constexpr std::size_t kGridBytesPerTriangle = 544;

}  // namespace pl
