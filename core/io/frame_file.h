// Names of the files of a sequence: the pictures of a camera path, in one folder.
#pragma once

#include <filesystem>

#include "core/io/image.h"

namespace pl {

/// FOLDER/frame_0001.png for index 0, with at least four digits; its suffix tells the kind.
std::filesystem::path frame_file(const std::filesystem::path& folder, int index, ImageKind kind);

}  // namespace pl
