#include "ui/draw/words.h"

#include <fmt/format.h>

namespace pl::ui {

const char* light_samples_text(bool on) { return on ? "light samples on" : "light samples off"; }

std::string passes_text(std::uint64_t count) { return fmt::format("{} {}", count, count == 1 ? "pass" : "passes"); }

}  // namespace pl::ui
