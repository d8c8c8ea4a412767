// Whether the CUDA back end can be used; this version has none, and says so.
#pragma once

#include <string>

namespace pl {

/// Why CUDA cannot be used, in words for `pathlight devices`. Never empty in this version.
std::string cuda_unavailable_reason();

}  // namespace pl
