// Lines of JSON for programs that read standard output.
#pragma once

#include <string>
#include <string_view>

#include "core/io/json_file.h"

namespace pl {

/// One line {"schema": "pathlight.event/1", "event": kind, ...members}, with its line feed. Invalid UTF-8 is
/// replaced; numbers that are not finite become null.
std::string event_line(std::string_view kind, const Json& members);

/// One line of any object.
std::string json_line(const Json& object);

}  // namespace pl
