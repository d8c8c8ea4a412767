// Names from files of others, as text that a terminal, a table or a page shows and does not obey.
#pragma once

#include <string>
#include <string_view>

namespace pl {

/// The text in UTF-8 with U+FFFD in the place of control characters other than line feed and tab, also control
/// characters of ISO 6429 beyond ASCII, and in the place of bytes that are no UTF-8.
std::string printable(std::string_view text);

/// A field of CSV that spreadsheets do not take for a formula. [RFC 4180]
std::string csv_text(std::string_view text);

/// Text in HTML and SVG: & < > and quotes are replaced, so that a name cannot end an element or an attribute.
std::string markup_text(std::string_view text);

/// Text in LaTeX, outside of formulas.
std::string latex_text(std::string_view text);

// Numbers as the shortest text that reads back as the same bits, whatever the locale.

std::string print_real(double value);
std::string print_float(float value);

}  // namespace pl
