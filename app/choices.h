// Option values that are one of several words, or some of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/choice.h"
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

/// The value of this name. Throws ChoiceError.
template <Described Enum>
Enum parse_choice(const std::string& text) {
    const std::optional<Enum> value = choice_named<Enum>(text);
    if (!value) fail_choice(choice_names<Enum>(), text);
    return *value;
}

/// "spare (default): what it says of itself; albedo: ...", as the help goes on.
template <Described Enum>
std::string describe_choices(std::optional<Enum> standard = {}) {
    std::string text;
    for (const ChoiceInfo<Enum>& info : kChoices<Enum>) {
        if (!text.empty()) text += "; ";
        text += info.name;
        if (info.value == standard) text += " (default)";
        if (!info.sentence.empty()) text.append(": ").append(info.sentence);
    }
    return text;
}

template <class Range, class Name>
std::vector<std::string> names_in(const Range& range, Name name) {
    std::vector<std::string> names;
    for (const auto& item : range) names.emplace_back(name(item));
    return names;
}

}  // namespace pl
