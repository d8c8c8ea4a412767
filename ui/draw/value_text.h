// Values, lists and methods in words.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "core/session/methods.h"

namespace pl::ui {

// Numbers as short texts.

/// "12.3 M": three digits and a power of a thousand.
std::string short_number(double value);
/// At most six characters and a sign: "0.25", "2.7e-4"; "nan", "inf".
std::string short_value(double value);
/// "1.25 s", "85 ms".
std::string short_seconds(double seconds);

// Settings and counts in words, the same in every part of the window.

/// "light samples on", "light samples off".
const char* light_samples_text(bool on);

/// "1 pass", "3 passes".
std::string passes_text(std::uint64_t count);

/// Lines that break at spaces alone: Dear ImGui also breaks after points and commas, within numbers. A number keeps its unit, the
/// next word, and a word that is wider than a line stays whole.
std::string broken_at_spaces(std::string_view text, float width,
                             const std::function<float(std::string_view)>& width_of);

// The keys of the methods, as messages and tooltips name them.

/// "1, 2, 3"; with a flag only the keys of methods for which it is set.
std::string method_keys(bool MethodInfo::*flag = nullptr);

}  // namespace pl::ui
