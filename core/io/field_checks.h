// Validation of learned fields from files, before kernels use their values as indices and probabilities.
#pragma once

#include <filesystem>

#include "core/session/learned_field.h"

namespace pl {

/// Throws Error(Input) with file, array, expected and actual value. `path` is for the message only.
void require_usable(const LearnedField& field, const std::filesystem::path& path);

}  // namespace pl
