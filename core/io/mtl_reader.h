// Parser of MTL text: checked entries in the order of the file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/mtl_entry.h"

namespace pl {

/// Of two materials with the same name the first counts. Adds warnings about duplicates, reflectances above 1
/// (clamped), implausible values of keys that other programs write (ignored), and ignored map options and statements
/// that would change the picture. Throws Error(Input) with file and line for an invalid value of Kd, Ke or a Pl_ key
/// and for a value before any newmtl.
std::vector<MtlEntry> read_mtl(std::string_view text, const std::filesystem::path& path,
                               std::vector<std::string>& warnings);

}  // namespace pl
