#include "app/parse_values.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "core/base/error.h"

namespace pl {
namespace {

/// The whole text as a number; a leading '+' is allowed.
template <class T>
std::optional<T> read(std::string_view text) {
    if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
    T value{};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end) return std::nullopt;
    return value;
}

}  // namespace

std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> parts;
    for (;;) {
        const std::size_t at = text.find(separator);
        parts.emplace_back(text.substr(0, at));
        if (at == std::string_view::npos) return parts;
        text.remove_prefix(at + 1);
    }
}

void fail_value(std::string_view expected, std::string_view got) {
    throw Error(ErrorKind::Usage, fmt::format("expected {}, got '{}'", expected, got));
}

std::uint64_t parse_whole(std::string_view text, std::uint64_t low, std::uint64_t high) {
    const auto value = read<std::uint64_t>(text);
    if (value && *value >= low && *value <= high) return *value;
    if (high == std::numeric_limits<std::uint64_t>::max())
        fail_value(fmt::format("a whole number of at least {}", low), text);
    fail_value(fmt::format("a whole number from {} to {}", low, high), text);
}

double parse_real(std::string_view text, double low, double high, std::string_view instead) {
    const auto value = read<double>(text);
    if (!value || !(*value >= low && *value <= high))
        fail_value(fmt::format("a number from {} to {}{}", low, high, instead), text);
    return *value;
}

float parse_float(std::string_view text) {
    const auto value = read<float>(text);
    if (!value || !std::isfinite(*value)) fail_value("a number", text);
    return *value;
}

std::vector<float> parse_floats(std::string_view text, std::initializer_list<std::size_t> counts,
                                std::string_view expected) {
    std::vector<float> values;
    for (const std::string& part : split(text, ',')) {
        const auto value = read<float>(part);
        if (!value || !std::isfinite(*value)) fail_value(expected, text);
        values.push_back(*value);
    }
    if (std::find(counts.begin(), counts.end(), values.size()) == counts.end()) fail_value(expected, text);
    return values;
}

glm::vec3 parse_vector(std::string_view text) {
    const std::vector<float> v = parse_floats(text, {3}, "three numbers X,Y,Z");
    return {v[0], v[1], v[2]};
}

bool parse_switch(std::string_view text) {
    if (text != "on" && text != "off") fail_value("on or off", text);
    return text == "on";
}

glm::ivec2 parse_size(std::string_view text) {
    const std::string expected = fmt::format("WIDTHxHEIGHT, each from 1 to {}", kMaxImageSide);
    const std::vector<std::string> parts = split(text, 'x');
    glm::ivec2 size{0};
    for (std::size_t i = 0; i < parts.size() && i < 2; ++i)
        size[static_cast<int>(i)] = read<int>(parts[i]).value_or(0);
    if (parts.size() != 2 || std::min(size.x, size.y) < 1 || std::max(size.x, size.y) > kMaxImageSide)
        fail_value(expected, text);
    return size;
}

std::string print_vector(const glm::vec3& v) {
    return fmt::format("{},{},{}", print_float(v.x), print_float(v.y), print_float(v.z));
}

}  // namespace pl
