// Display name of the processor.
#pragma once

#include <string>

namespace pl {

/// "AMD EPYC 9654"; "CPU" if the system reports no name.
std::string cpu_name();

}  // namespace pl
