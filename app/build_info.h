// What this program was built from.
#pragma once

#include <string_view>

namespace pl {

/// The commit as 'git describe --always --dirty' names it at the time of the build; "unknown" outside of git.
std::string_view commit_id();

}  // namespace pl
