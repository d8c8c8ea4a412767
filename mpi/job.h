// The job of mpirun that this process belongs to.
#pragma once

#include <memory>
#include <string>

#include "mpi/communicator.h"

namespace pl {

/// The ranks of the job; null if mpirun has not started this process, or started it alone. `version` tells programs
/// apart. Throws Error(Unavailable), on every rank, if some rank has another version or if this program is built
/// without MPI. The destructor leaves the job.
std::unique_ptr<Communicator> join_job(const std::string& version);

/// Number of ranks of the job on this machine; 1 without a job.
int ranks_on_this_machine();
/// Whether this process tells why it cannot join. Rank 0 does, which hears of the other ranks. A program without MPI
/// always does, because the program of rank 0 may be another program, which cannot hear of this one.
bool tells_why_not_joined();

}  // namespace pl
