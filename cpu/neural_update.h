// The update of a neural field: the network learns from the tables, and the tables are sampled by both.
#pragma once

#include "core/fields/neural_model.h"
#include "core/fields/placement_storage.h"

namespace pl {

/// Teaches the network by a few steps of gradient descent on the learned radiance of the tables, whose pending sums have been
/// absorbed, and rebuilds all cumulative probabilities with its predictions as prior. What the tables have learned is only
/// read. The same bits for any number of threads and any instruction set. A network that is not finite is given up: the
/// tables are then sampled without it, see kNetworkIsLost.
void update_network(const FieldShape& shape, const HostVolumes& volumes, HostNeural& field, int threads);

}  // namespace pl
