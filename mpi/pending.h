// The training samples of all ranks, summed before a field is updated.
#pragma once

#include "core/session/exact_backend.h"
#include "mpi/communicator.h"

namespace pl {

/// Replaces the pending sums of every rank by their sum over all ranks: as a list of the sums that are not 0, or as
/// whole arrays, whichever is fewer bytes. Integers: the same sums in any order.
void sum_pending(Communicator& ranks, ExactBackend& backend, MethodId method);

/// Clears the pending sums of this rank.
void clear_pending(ExactBackend& backend, MethodId method);

}  // namespace pl
