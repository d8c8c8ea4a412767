// The folder of the scenes and tables that come with the program.
#pragma once

#include <filesystem>

namespace pl::test {

inline const std::filesystem::path kAssets = PL_SOURCE_DIR "/assets";

}  // namespace pl::test
