// When the placement of volumes is refined while a method learns, and by how many volumes.
#pragma once

#include <optional>

#include "core/fields/refine_placement.h"
#include "core/session/learned_field.h"

namespace pl {

/// Volumes to add right after an update, when no training sample is pending; empty if no round of refinement is due, 0 if
/// one is due that adds none. `volumes` is their number now, `progress` that of the method that learns. Passes are counted
/// as fields keep them, so that a field that was saved in between is refined at the same moment.
std::optional<std::size_t> volumes_to_add(const FieldSettings& settings, std::size_t volumes,
                                          const Refinement& so_far, const FieldProgress& progress);

}  // namespace pl
