// MTL text to entries: what is written, checked and in the order of the file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/mtl_entry.h"

namespace pl {

/// Of two materials with one name the first counts. Warnings tell of that, of reflectances above 1 (clamped), of
/// numbers of other programs that cannot be meant (left out), of options of maps and of statements that change a
/// picture and are left out. Throws Error(Input) with file and line: Kd, Ke or a key of our own with a value that is
/// none, a value before any newmtl.
std::vector<MtlEntry> read_mtl(std::string_view text, const std::filesystem::path& path,
                               std::vector<std::string>& warnings);

}  // namespace pl
