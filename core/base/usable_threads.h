// The number of threads that run at once here: processors that this process may use, within the quota of its control group.
#pragma once

#include <optional>
#include <string_view>

namespace pl {

/// At least 1. A container may see all processors of its machine and have the time of a few: further threads would wait for one another.
int usable_threads();

/// Processors by the file cpu.max of a control group, rounded up: "QUOTA PERIOD", in microseconds. None without a limit, "max PERIOD",
/// and for other text.
std::optional<int> processors_of_quota(std::string_view text);

}  // namespace pl
