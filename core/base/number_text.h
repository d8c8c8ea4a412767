// Numbers as the shortest text that reads back as the same bits, whatever the locale.
#pragma once

#include <string>

namespace pl {

std::string print_real(double value);
std::string print_float(float value);

}  // namespace pl
