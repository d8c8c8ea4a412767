// Settings and counts in words, the same in every part of the window.
#pragma once

#include <cstdint>
#include <string>

namespace pl::ui {

/// "light samples on", "light samples off".
const char* light_samples_text(bool on);

/// "1 pass", "3 passes".
std::string passes_text(std::uint64_t count);

}  // namespace pl::ui
