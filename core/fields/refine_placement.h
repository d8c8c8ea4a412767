// Refinement: splitting radiance volumes that many paths use and whose neighbors disagree.
#pragma once

#include <span>
#include <vector>

#include "core/fields/field_model.h"
#include "core/fields/place_volumes.h"

namespace pl {

/// Rounds of refinement of a placement so far, and the number of volumes they added: the last ones of the placement.
struct Refinement {
    std::uint32_t rounds = 0;
    std::uint32_t added = 0;

    friend bool operator==(const Refinement&, const Refinement&) = default;
};

/// Volumes with their tree but without a grid: the old ones with their numbers, then the new ones.
struct RefinedPlacement {
    HostVolumes volumes;
    std::vector<std::uint32_t> parents;  ///< of the new volumes, in their order; no number twice
};

/// Splits each of the volumes `split` once, by another volume on a surface that it serves. The new site is the best
/// second center of a least-squares quantizer of the volume's Voronoi cell, among the points of a denser placement,
/// so that it is a position place_volumes() can choose. Volumes whose cell has no point that reduces the error are
/// not split. Deterministic; scaling the scene by a power of two scales the result.   [Lloyd 1982]
/// `source` is that of the placement, but for the camera, which is the present one.
RefinedPlacement refine_placement(const SiteSource& source, const PlacementView& placement,
                                  std::span<const std::uint32_t> split);

/// Up to `most` volumes to split, by the tables of the field. None without tables: other representations are refined by their updates.
std::vector<std::uint32_t> volumes_to_split(const AnyFieldView& field, std::size_t most, int threads);

}  // namespace pl
