// Checks of a field from a file, before kernels use its numbers as indices and probabilities.
#pragma once

#include <filesystem>

#include "core/session/learned_field.h"

namespace pl {

/// Throws Error(Input) that names file, place, what was expected and what was got. `path` is only for the message.
void require_usable(const LearnedField& field, const std::filesystem::path& path);

}  // namespace pl
