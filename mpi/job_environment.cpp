#include <algorithm>
#include <cstdlib>

#include "mpi/job.h"
#include "mpi/job_environment.h"

namespace pl {

int job_number(const char* name, int otherwise) {
    const char* const text = std::getenv(name);
    return text != nullptr ? std::atoi(text) : otherwise;
}

int ranks_on_this_machine() { return std::max(1, job_number("OMPI_COMM_WORLD_LOCAL_SIZE", 1)); }

}  // namespace pl
