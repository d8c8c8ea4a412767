// Option values that are one of several words, or some of them.
#pragma once

#include <string>
#include <vector>

#include "core/base/error.h"

namespace pl {

/// The items of "a,b,c".
std::vector<std::string> split_at_commas(const std::string& text);

/// "a, b or c"
std::string one_of(const std::vector<std::string>& names);

/// A word that is none of the known ones. Completions of shells are made of them.
class ChoiceError : public Error {
public:
    ChoiceError(const std::string& message, const std::vector<std::string>& names)
        : Error(ErrorKind::Usage, message), names_(names) {}
    const std::vector<std::string>& names() const { return names_; }

private:
    std::vector<std::string> names_;
};

/// Throws ChoiceError with all words, and the nearest one if any is near.
[[noreturn]] void fail_choice(const std::vector<std::string>& names, const std::string& got);

template <class Range, class Name>
std::vector<std::string> names_in(const Range& range, Name name) {
    std::vector<std::string> names;
    for (const auto& item : range) names.emplace_back(name(item));
    return names;
}

}  // namespace pl
