#include "ui/draw/value_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

namespace pl::ui {

std::string short_number(double value) {
    constexpr const char* kUnits[] = {"", " k", " M", " G", " T"};
    int unit = 0;
    while (std::fabs(value) >= 999.5 && unit < 4) {
        value /= 1000.0;
        ++unit;
    }
    return unit == 0 && value == std::floor(value) ? fmt::format("{:.0f}", value)
                                                   : fmt::format("{:.3g}{}", value, kUnits[unit]);
}

std::string short_value(double value) {
    if (!std::isfinite(value)) return fmt::format("{}", value);
    const double magnitude = std::fabs(value);
    if (magnitude >= 999.5 && magnitude < 9999.5) return fmt::format("{:.0f}", value);
    if (magnitude == 0.0 || (magnitude >= 0.01 && magnitude < 999.5)) return fmt::format("{:.3g}", value);
    if (magnitude >= 0.00995 && magnitude < 0.01) return fmt::format("{:.1g}", value);  // not 10.0e-3
    const std::string text = fmt::format("{:.1e}", value);                              // rounded: "9.9e-05"
    const std::size_t mark = text.find('e');
    return fmt::format("{}e{}", text.substr(0, mark), std::stoi(text.substr(mark + 1)));
}

std::string short_seconds(double seconds) {
    if (seconds < 1.0) return fmt::format("{:.3g} ms", 1000.0 * seconds);
    if (seconds < 100.0) return fmt::format("{:.2f} s", seconds);
    return fmt::format("{:.0f} s", seconds);
}

const char* light_samples_text(bool on) { return on ? "light samples on" : "light samples off"; }

std::string passes_text(std::uint64_t count) { return fmt::format("{} {}", count, count == 1 ? "pass" : "passes"); }

std::string broken_at_spaces(std::string_view text, float width,
                             const std::function<float(std::string_view)>& width_of) {
    std::string lines(text);
    const float space = width_of(" ");
    float used = 0.0f;
    for (std::size_t start = 0; start < text.size();) {
        std::size_t end = std::min(text.find_first_of(" \n", start), text.size());
        if (end > start && end < text.size() && text[end] == ' ' &&
            std::isdigit(static_cast<unsigned char>(text[end - 1])))
            end = std::min(text.find_first_of(" \n", end + 1), text.size());
        const float word = width_of(text.substr(start, end - start));
        if (used > 0.0f && end > start && used + word > width) {
            lines[start - 1] = '\n';
            used = 0.0f;
        }
        used = end < text.size() && text[end] == '\n' ? 0.0f : used + word + space;
        start = end + 1;
    }
    return lines;
}

std::string method_keys(bool MethodInfo::*flag) {
    std::string keys;
    for (const MethodInfo& method : all_methods())
        if (flag == nullptr || method.*flag) keys += (keys.empty() ? "" : ", ") + std::string(1, method.key);
    return keys;
}

}  // namespace pl::ui
