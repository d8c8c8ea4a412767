// What follows `map_Kd` and its like: options, then the name of an image.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/io/mtl_entry.h"

namespace pl {

struct ParsedMap {
    MtlMap map;                            ///< empty if there is no name
    std::vector<std::string> unsupported;  ///< options that would change the picture
};

/// The name is all that is left after the options, blanks included.
ParsedMap parse_map(std::string_view arguments);

}  // namespace pl
