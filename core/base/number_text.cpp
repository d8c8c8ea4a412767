#include "core/base/number_text.h"

#include <charconv>

namespace pl {
namespace {

template <class T>
std::string print(T value) {
    char buffer[64];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
    return error == std::errc{} ? std::string(buffer, end) : std::string();
}

}  // namespace

std::string print_real(double value) { return print(value); }

std::string print_float(float value) { return print(value); }

}  // namespace pl
