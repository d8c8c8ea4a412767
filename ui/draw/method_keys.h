// The keys of the methods, as messages and tooltips name them.
#pragma once

#include <string>

#include "core/session/methods.h"

namespace pl::ui {

/// "1, 2, 3"; with a flag only the keys of methods for which it is set.
std::string method_keys(bool MethodInfo::*flag = nullptr);

}  // namespace pl::ui
