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
/// Whether this is rank 0, which alone prints, or no rank of a job.
bool is_first_rank();

}  // namespace pl
