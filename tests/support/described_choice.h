// What has to hold of an enumeration that describes itself.
#pragma once

#include <cctype>
#include <set>
#include <utility>

#include "core/base/choice.h"
#include "tests/support/catch.hpp"

namespace pl::test {

/// Whether the enumeration has a name for a value: compilers write others as a cast of their number.
template <auto kValue>
constexpr bool is_enumerator() {
    constexpr std::string_view kBegin = "kValue = ";
    const std::string_view text = __PRETTY_FUNCTION__;
    return text[text.find(kBegin) + kBegin.size()] != '(';
}
enum class Number { One = 1 };
static_assert(is_enumerator<Number::One>() && !is_enumerator<Number{2}>());

/// No two values share a name or a label, and sentences can stand between a colon and a period.
template <Described Enum>
void check_texts() {
    std::set<std::string_view> names, labels;
    for (const ChoiceInfo<Enum>& info : kChoices<Enum>) {
        CAPTURE(std::string(info.name));
        CHECK(choice_named<Enum>(info.name) == info.value);
        CHECK((names.insert(info.name).second && labels.insert(info.label).second));
        CHECK_FALSE((info.name.empty() || info.label.empty()));
        if (info.sentence.empty()) continue;
        CHECK(std::isupper(static_cast<unsigned char>(info.sentence.front())) == 0);
        CHECK((info.sentence.back() != '.' && info.sentence.find(';') == std::string_view::npos));
    }
}

/// Besides, every enumerator below 64 is described.
template <Described Enum>
void check_choice() {
    check_texts<Enum>();
    [&]<std::size_t... kNumbers>(std::index_sequence<kNumbers...>) {
        const auto check = [](std::size_t number, bool is_named) {
            CAPTURE(number);
            if (is_named) CHECK(is_choice(static_cast<Enum>(number)));
        };
        (check(kNumbers, is_enumerator<static_cast<Enum>(kNumbers)>()), ...);
    }
    (std::make_index_sequence<64>{});
}

}  // namespace pl::test
