// The instruction sets of the lane kernels, by name, for callers that do not need the kernels.
#pragma once

#include <string_view>
#include <vector>

namespace pl {

/// Instruction sets that this build has kernels for, narrowest vectors first.
std::vector<std::string_view> compiled_lane_names();
/// The instruction set whose kernels run on this machine.
std::string_view used_lane_name();

}  // namespace pl
