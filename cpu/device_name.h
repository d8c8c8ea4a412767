// What the processor is called, for people.
#pragma once

#include <string>

namespace pl {

/// "AMD EPYC 9654"; "CPU" where the system does not tell.
std::string cpu_name();

}  // namespace pl
