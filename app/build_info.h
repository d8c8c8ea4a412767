// What this program was built from.
#pragma once

#include <string_view>

namespace pl {

/// The commit as 'git describe --always --dirty' names it at the time of the build; "unknown" outside of git. Of the target
/// pl_commit, which every program with pl_app in it has to link.
std::string_view commit_id();

}  // namespace pl
