// "Did you mean ...?": the known name with the smallest edit distance.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pl {

/// The candidate with the smallest Levenshtein distance to `name`, the first of equals; candidates that begin with
/// `name` have distance 1. Empty without candidates.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace pl
