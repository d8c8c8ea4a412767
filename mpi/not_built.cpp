// A program without MPI.
#include "core/base/error.h"
#include "mpi/job.h"
#include "mpi/job_environment.h"

namespace pl {

std::unique_ptr<Communicator> join_job(const std::string&) {
    if (job_size() <= 1) return nullptr;
    throw Error(ErrorKind::Unavailable, "rank " + std::to_string(job_number("OMPI_COMM_WORLD_RANK", 0)) +
                                            ": mpirun has started " + std::to_string(job_size()) +
                                            " processes, but this program is built without MPI (" PL_MPI_MISSING
                                            "): './run --with mpi' builds one that shares the work");
}

bool tells_why_not_joined() { return true; }

}  // namespace pl
