// "Did you mean ...?": the known name that a misspelt one is near.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pl {

/// Whether a user who typed `name` is likely to have meant `known`: they are equal but for the case of letters, or `name` is an
/// abbreviation, the first three letters or more; or the longer one has at least four letters, and no more than a third of them are
/// inserted, left out, replaced or swapped with their neighbors. So `rendr` is near `render`, but `gpu` is not near `cpu`: one letter of
/// three is another word. Dashes in front do not count.   [Damerau 1964, "A Technique for Computer Detection and Correction of
/// Spelling Errors"]
bool is_near(std::string_view name, std::string_view known);

/// The nearest of the candidates that is_near(), the first of equals; empty if none is.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

/// ", did you mean 'NAME'?" with nearest_name(); empty if none is near.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);
/// The same, then " Known are: A, B" with all of them.
std::string known_names(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace pl
