// Disagreement of a volume's table with those of its neighbors, and the volumes best split for it.
#pragma once

#include <vector>

#include "core/kernel/guiding/table_field.h"

namespace pl {

/// Neighbors that a volume is compared with: about those whose Voronoi cells touch its own on a plane.
inline constexpr int kComparedNeighbors = 4;

/// Squared Hellinger distance 1 - sum sqrt(p q) of two volumes' tables, in [0, 1]. p are the probabilities of the cells of
/// `volume`, q those that the table of `other` gives them as seen from the site of `volume`, mapped by Parallax as guided paths
/// map it, so that differences due to position alone count as little as they do for paths. Only every second cell counts, a
/// checkerboard, since updates smooth the others with these. 1 if `other` has no density in that hemisphere.
/// [Hellinger 1909]
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
