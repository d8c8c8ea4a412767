// Text for terminals: names of files that others made may hold what a terminal obeys.
#pragma once

#include <string>
#include <string_view>

namespace pl {

/// The text in UTF-8 with U+FFFD in the place of control characters other than line feed and tab, those of ISO 6429 beyond
/// ASCII included, and of bytes that are no UTF-8.
std::string printable(std::string_view text);

// Numbers as the shortest text that reads back as the same bits, whatever the locale.

std::string print_real(double value);
std::string print_float(float value);

}  // namespace pl
