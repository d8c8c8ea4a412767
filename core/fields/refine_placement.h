// Splitting radiance volumes where a table has to answer for too much: where many paths ask, and the volumes around say
// something else.
#pragma once

#include <span>
#include <vector>

#include "core/fields/make_field.h"

namespace pl {

/// How often a placement was refined, and by how much: its last volumes.
struct Refinement {
    std::uint32_t rounds = 0;
    std::uint32_t added = 0;

    friend bool operator==(const Refinement&, const Refinement&) = default;
};

/// Volumes with their tree but without a grid: first those that were there, each in its place and with its number.
struct RefinedPlacement {
    HostVolumes volumes;
    std::vector<std::uint32_t> parents;  ///< of the new volumes, in their order: no number twice
};

/// Splits up to `most` volumes, the worst_volumes(), each once: by another one that stands on a surface that it served,
/// where the two leave the points of its cell closest to one of them. That is the best second center of a least-squares
/// quantizer, tried at points of a denser placement, so it stands where place_volumes() could have put one: on a
/// reflecting side that light reaches. Volumes whose cell has no such point stay alone. Deterministic; scaling the scene by a
/// power of two scales the result.   [Lloyd 1982]
/// `field` has placement and published tables, `settings` are those of the placement.
RefinedPlacement refine_placement(const HostScene& scene, const FieldSettings& settings, const TableField& field,
                                  std::size_t most, int threads);

/// Tables of a refined placement: a new volume begins with the published table of its parent, with its BSDF share and
/// its reach. The records that these rest on are divided, cell by cell and evenly, the odd one by turns: about half of
/// the points now are the child's, and with half the records in each a new one still counts as much. None is lost or
/// counted twice; a cell that is left without a record has learned nothing. What is pending stays with the parent.
HostTables split_tables(const FieldShape& shape, HostTables tables, std::span<const std::uint32_t> parents);

}  // namespace pl
