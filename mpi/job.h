// The job of mpirun that this process belongs to.
#pragma once

#include <memory>
#include <string>

#include "mpi/communicator.h"

namespace pl {

/// The ranks of the job; null if mpirun has not started this process, or started it alone. `version` tells programs apart: Throws
/// Error(Unavailable), on every rank, if that of some rank is another one or if this program is built without MPI. The destructor
/// leaves the job.
std::unique_ptr<Communicator> join_job(const std::string& version);

/// Number of ranks of the job on this machine; 1 without a job.
int ranks_on_this_machine();
/// Whether this process tells why it cannot join. Rank 0 does, which hears of the others; a program without MPI always, because that of
/// rank 0 may be another one, which cannot hear of it.
bool tells_why_not_joined();

}  // namespace pl
