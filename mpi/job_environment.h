// Numbers that mpirun of Open MPI gives to the processes that it starts, before they ask MPI.
#pragma once

namespace pl {

/// Value of an environment variable, or `otherwise`.
int job_number(const char* name, int otherwise);

/// Processes of the job; 1 without mpirun.
inline int job_size() { return job_number("OMPI_COMM_WORLD_SIZE", 1); }

}  // namespace pl
