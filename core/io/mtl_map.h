// Arguments of `map_Kd` and other map statements: options, then the name of an image.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/io/mtl_entry.h"

namespace pl {

struct ParsedMap {
    MtlMap map;                            ///< empty if there is no name
    std::vector<std::string> unsupported;  ///< options with values that would change the picture
};

/// The name is the rest after the options, with blanks or in quotes.
ParsedMap parse_map(std::string_view arguments);

}  // namespace pl
