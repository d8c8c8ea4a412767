// How much a volume's table differs from what those around it would say in its place, and which volumes it is best to
// split for it.
#pragma once

#include <vector>

#include "core/fields/field_storage.h"

namespace pl {

/// Neighbours that a volume is compared with: about those whose cells touch its own on a plane.
inline constexpr int kComparedNeighbours = 4;

/// Squared Hellinger distance 1 - sum sqrt(p q) of two volumes' published tables, in [0, 1]. p are the probabilities of
/// the cells of `volume`, q what the table of `other` gives them as seen from the site of `volume`, carried there as
/// guided paths carry it (Parallax), so that what differs by the place alone counts as little as it does to them. Both
/// are taken in every second cell, a checkerboard: publication smooths those between with these. 1 if the other one
/// knows nothing of that hemisphere. `field` has placement and tables.   [Hellinger 1909]
double hellinger2(const TableField& field, std::int32_t volume, std::int32_t other);

/// Up to `most` volumes whose splitting promises most, best first, ties to the lower number: those with the largest
/// n H^2 V^2, with n a volume's records, V its mean radiance, and H^2 its mean squared Hellinger distance to its nearest
/// neighbours with agreeing normals, each weighted by its records, since one that knows little says little.
/// * n H^2: were all tables drawn from the same light, this would be the same for all n (8 n H^2 is chi-square
///   distributed), so tables that differ by noise alone gain nothing by having had many or few records.
///   [Freeman and Tukey 1950; Matusita 1955]
/// * V^2: what a volume's directions leave of squared noise in the picture grows so, and rooms in the dark have none to
///   lose. Tried without it, and with V; see docs/learning.md.
/// None where this is 0: where nothing was learned, or all say the same. Does not depend on the number of threads.
std::vector<std::uint32_t> worst_volumes(const TableField& field, std::size_t most, int threads);

}  // namespace pl
