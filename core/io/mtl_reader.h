// Parser of MTL text: checked entries in the order of the file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/mtl_entry.h"

namespace pl {

/// Of two materials with the same name the first counts. Adds warnings about duplicates, reflectances above 1
/// (clamped), values that cannot be meant and unknown keys (left out), and ignored map options and statements
/// that would change the picture. Throws Error(Input) with file and line for a control character.
std::vector<MtlEntry> read_mtl(std::string_view text, const std::filesystem::path& path,
                               std::vector<std::string>& warnings);

}  // namespace pl
