// The version of the source that this program was built from.
#pragma once

#include <string_view>

namespace pl {

/// The commit as 'git describe --always --dirty' names it at build time; "unknown" outside of git. Defined in the
/// target pl_commit, which every program with pl_app in it has to link.
std::string_view commit_id();

}  // namespace pl
