// Lines of JSON for programs that read standard output.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace pl {

using Json = nlohmann::ordered_json;

/// One line {"schema": "pathlight.event/1", "event": kind, ...members}, with its line feed. Bytes that are no UTF-8
/// are replaced; numbers that are not finite become null.
std::string event_line(std::string_view kind, const Json& members);

/// One line of any object.
std::string json_line(const Json& object);

}  // namespace pl
