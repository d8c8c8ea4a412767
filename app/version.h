// What a report of a fault has to say about the program.
#pragma once

#include <string>

namespace pl {

/// Lines of name and value: version, commit, compiler, back ends, vectors, MPI. Starts with "pathlight VERSION".
std::string version_text();

/// Version and commit: programs of equal identity understand each other as ranks of one job.
std::string program_identity();

}  // namespace pl
