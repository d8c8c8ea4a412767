// A program without MPI.
#include "core/base/error.h"
#include "mpi/job.h"
#include "mpi/job_environment.h"

namespace pl {

std::unique_ptr<Communicator> join_job(const std::string&) {
    if (job_size() <= 1) return nullptr;
    throw Error(ErrorKind::Unavailable, "mpirun has started " + std::to_string(job_size()) + " processes, but " +
                                            mpi_missing_reason() +
                                            ": './run --with mpi' builds a program that shares the work");
}

std::string mpi_missing_reason() { return "this program is built without MPI (" PL_MPI_MISSING ")"; }

}  // namespace pl
