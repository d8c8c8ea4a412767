// A program without MPI.
#include "core/base/error.h"
#include "mpi/job.h"
#include "mpi/job_environment.h"

namespace pl {

std::unique_ptr<Communicator> join_job(const std::string&) {
    if (job_size() <= 1) return nullptr;
    throw Error(ErrorKind::Unavailable, "mpirun has started " + std::to_string(job_size()) +
                                            " processes, but this program is built without MPI (" PL_MPI_MISSING
                                            "): './run --with mpi' builds one that shares the work");
}

}  // namespace pl
