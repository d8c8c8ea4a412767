// When the placement of volumes is refined while a method learns, and by how many volumes.
#pragma once

#include <optional>

#include "core/fields/refine_placement.h"
#include "core/session/learned_field.h"

namespace pl {

/// Number of volumes to add right after an update, when no training sample is pending; empty if no round of
/// refinement is due, 0 if one is due that adds none. `volumes`: their present number. `progress`: of the
/// learning method. Passes are counted by the field's progress, so that a field saved in between is refined at the
/// same moment. `light_clusters`: of the scene's light tree, for the memory of a volume.
std::optional<std::size_t> volumes_to_add(const FieldSettings& settings, std::size_t volumes,
                                          const Refinement& so_far, const FieldProgress& progress,
                                          std::size_t light_clusters = 0);

}  // namespace pl
