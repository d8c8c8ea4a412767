// The update of the network of a neural field.
#pragma once

#include "core/fields/neural_model.h"
#include "core/fields/placement_storage.h"

namespace pl {

/// Teaches the network by a few steps of gradient descent on the Kullback-Leibler divergence of its mixtures at the sites of volumes from
/// the probabilities of their tables, whose pending sums have been absorbed and which are only read. The same bits for any number of
/// threads and any instruction set. A network that is not finite is given up: paths are then guided by the cosine, see kNetworkIsLost.
void update_network(const FieldShape& shape, const HostVolumes& volumes, HostNeural& field, int threads);

}  // namespace pl
