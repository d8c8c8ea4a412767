// Numbers as short texts.
#pragma once

#include <string>

namespace pl::ui {

/// "12.3 M": three digits and a power of a thousand.
std::string short_number(double value);
/// At most six characters and a sign: "0.25", "2.7e-4"; "nan", "inf".
std::string short_value(double value);
/// "1.25 s", "85 ms".
std::string short_seconds(double seconds);

}  // namespace pl::ui
