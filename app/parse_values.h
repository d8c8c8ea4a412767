// From texts of the command line and of scene settings to values, and back. Errors are Error(Usage) "expected ...,
// got '...'"; the caller puts the option's name in front.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "core/base/printable.h"

namespace pl {

[[noreturn]] void fail_value(std::string_view expected, std::string_view got);

/// The parts between separators, at least one.
std::vector<std::string> split(std::string_view text, char separator);

/// Whole number within [low, high].
std::uint64_t parse_whole(std::string_view text, std::uint64_t low, std::uint64_t high);
/// Finite decimal number within [low, high]. `instead` names further values in the error message, such as ", or
/// auto".
double parse_real(std::string_view text, double low, double high, std::string_view instead = {});
/// Finite number that fits a float.
float parse_float(std::string_view text);
/// Numbers separated by commas; `counts` are the allowed lengths.
std::vector<float> parse_floats(std::string_view text, std::initializer_list<std::size_t> counts,
                                std::string_view expected);
glm::vec3 parse_vector(std::string_view text);
/// "on" or "off".
bool parse_switch(std::string_view text);
/// "WIDTHxHEIGHT", each within [1, kMaxImageSide].
glm::ivec2 parse_size(std::string_view text);

inline constexpr int kMaxImageSide = 16384;

std::string print_vector(const glm::vec3& v);

}  // namespace pl
