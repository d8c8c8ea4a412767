// A learner in the place of the table's own: at every update it is told the pending sums of all volumes and returns what directions are
// sampled by. Whatever it returns, each cell keeps its uniform share and paths know their exact densities, so that the mean of a picture
// does not depend on it.
#pragma once

#include <functional>
#include <vector>

#include "core/fields/placement_storage.h"
#include "core/fields/table_model.h"

namespace pl {

/// The field before an update.
struct LearnerInput {
    const FieldShape& shape;
    const HostVolumes& volumes;
    const HostTables& tables;  ///< with the pending sums of the training samples since the last update
};

/// The answer of a learner: a number for each cell, finite and at least 0. [volume][cell]
struct LearnedCells {
    /// True: learned incident radiance, from which means and probabilities follow as from the table's own. False: probabilities,
    /// of each volume up to a factor; the table's own radiance stays the value of volumes.
    bool are_radiance = false;
    std::vector<float> values;
};

/// Called between passes. May throw anything: Session::advance() then throws it, after a whole pass.
using FieldLearner = std::function<LearnedCells(const LearnerInput&)>;

/// Throws Error(Input) that names the first volume and cell with another number, or for another length.
void require_cells(const FieldShape& shape, std::size_t volumes, const LearnedCells& cells);

/// Replaces what an update has made of the table's own radiance. Expects cells that require_cells() accepts, and no pending sums.
/// Volumes whose numbers are all 0, or have no finite sum, get the uniform distribution.
void take_cells(const FieldShape& shape, HostTables& tables, const LearnedCells& cells);

}  // namespace pl
