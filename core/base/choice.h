// A choice describes itself: what users read of each value of an enumeration is written once, beside the enumeration. Command line,
// help, window, messages and files take it from there.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace pl {

template <class Enum>
struct ChoiceInfo {
    Enum value;
    std::string_view name;   ///< on the command line and in files
    std::string_view label;  ///< on screen
    std::string_view
        sentence{};  ///< follows name or label and a colon, and ends without a period; empty if they say it all
};

/// The values of an enumeration, as std::array of ChoiceInfo in the order of lists: specialized for each that users choose from.
template <class Enum>
inline constexpr std::nullptr_t kChoices = nullptr;

template <class Enum>
concept Described = std::is_enum_v<Enum> && !std::is_null_pointer_v<std::remove_const_t<decltype(kChoices<Enum>)>>;

/// Place of a value in kChoices; behind the last for a number that is none of them.
template <Described Enum>
constexpr std::size_t choice_index(Enum value) {
    return static_cast<std::size_t>(std::ranges::find(kChoices<Enum>, value, &ChoiceInfo<Enum>::value) -
                                    kChoices<Enum>.begin());
}

template <Described Enum>
constexpr bool is_choice(Enum value) {
    return choice_index(value) < kChoices<Enum>.size();
}

/// Empty for a number that is no choice.
template <Described Enum>
constexpr std::string_view name_of(Enum value) {
    return is_choice(value) ? kChoices<Enum>[choice_index(value)].name : "";
}
template <Described Enum>
constexpr std::string_view label_of(Enum value) {
    return is_choice(value) ? kChoices<Enum>[choice_index(value)].label : "";
}

template <Described Enum>
constexpr std::optional<Enum> choice_named(std::string_view name) {
    for (const ChoiceInfo<Enum>& info : kChoices<Enum>)
        if (info.name == name) return info.value;
    return std::nullopt;
}

template <Described Enum>
std::vector<std::string> choice_names() {
    std::vector<std::string> names;
    for (const ChoiceInfo<Enum>& info : kChoices<Enum>) names.emplace_back(info.name);
    return names;
}

}  // namespace pl
