// What a report of a fault has to say about the program.
#pragma once

#include <string>
#include <string_view>

namespace pl {

// The source that this program was built from: its version and its licences.

/// The commit as 'git describe --always --dirty' names it at build time; "unknown" outside of git. Defined in the
/// target pl_commit, which every program with pl_app in it has to link.
std::string_view commit_id();

/// LICENSE and THIRD-PARTY.md of the source, as they were when the build was configured.
std::string_view license_text();
std::string_view third_party_text();

/// Lines of name and value: version, commit, compiler, back ends, vectors, MPI. Starts with "pathlight VERSION".
std::string version_text();

/// Version and commit: programs of equal identity understand each other as ranks of one job.
std::string program_identity();

}  // namespace pl
