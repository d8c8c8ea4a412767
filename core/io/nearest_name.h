// "Did you mean ...?": the known name that takes the fewest edits.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pl {

/// The candidate with the smallest Levenshtein distance to `name`, the first of equals; one that begins with `name`
/// counts as one edit away. Empty without candidates.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace pl
