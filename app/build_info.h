// The source that this program was built from: its version and its licences.
#pragma once

#include <string_view>

namespace pl {

/// The commit as 'git describe --always --dirty' names it at build time; "unknown" outside of git. Defined in the
/// target pl_commit, which every program with pl_app in it has to link.
std::string_view commit_id();

/// LICENSE and THIRD-PARTY.md of the source, as they were when the build was configured.
std::string_view license_text();
std::string_view third_party_text();

}  // namespace pl
