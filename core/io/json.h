// The one type of JSON values. Its members are compiled in json_file.cpp alone: every file that uses them would else take seconds for
// them.
#pragma once

#include <nlohmann/json.hpp>

namespace pl {

/// Members stay in the order in which they were written.
using Json = nlohmann::ordered_json;

}  // namespace pl

extern template class nlohmann::basic_json<nlohmann::ordered_map>;
