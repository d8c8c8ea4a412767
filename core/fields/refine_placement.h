// Refinement: splitting radiance volumes that many paths use and whose neighbors disagree with them.
#pragma once

#include <span>
#include <vector>

#include "core/fields/field_model.h"
#include "core/fields/place_volumes.h"
#include "core/kernel/guiding/table_field.h"

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
/// `source`: the source of the placement, with the present camera.
RefinedPlacement refine_placement(const SiteSource& source, const PlacementView& placement,
                                  std::span<const std::uint32_t> split);

/// Up to `most` volumes to split, by the tables of the field. None without tables: other representations are refined by their updates.
std::vector<std::uint32_t> volumes_to_split(const AnyFieldView& field, std::size_t most, int threads);

/// Neighbors that a volume is compared with: about the volumes whose Voronoi cells touch its own on a plane.
inline constexpr int kComparedNeighbors = 4;

/// Squared Hellinger distance 1 - sum sqrt(p q) of two volumes' tables, in [0, 1]. p are the probabilities of the cells of
/// `volume`, q the probabilities that the table of `other` gives these cells as seen from the site of `volume`,
/// mapped by Parallax as guided paths map it, so that differences due to position alone count as little as they do
/// for paths. Only every second cell counts, a checkerboard, since updates smooth the others with these. 1 if `other`
/// has no density in that hemisphere.   [Hellinger 1909]
double hellinger2(const TableField& field, std::int32_t volume, std::int32_t other);

/// Up to `most` volumes to split, best first, ties to the lower number: those with the largest n H^2 V^2, with n a volume's
/// training samples, V its mean radiance, and H^2 its mean squared Hellinger distance to its nearest neighbors with agreeing
/// normals, weighted by their training samples.
/// * n H^2: for tables drawn from the same radiance its distribution is the same for all n (8 n H^2 is chi-square
///   distributed), so tables that differ by noise alone are not preferred for many or few training samples.
///   [Freeman and Tukey 1950; Matusita 1955]
/// * V^2: the variance that a volume's directions leave in the picture grows with it. Alternatives are compared in
///   docs/notebook/2026-11-22-refinement.md.
/// None with a product of 0. Does not depend on the number of threads.
std::vector<std::uint32_t> volumes_to_split(const TableField& field, std::size_t most, int threads);

}  // namespace pl
