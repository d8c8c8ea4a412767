// Small pictures of cameras, kept as files.
#pragma once

#include <filesystem>
#include <optional>

#include "core/io/image.h"

namespace pl::ui {

inline constexpr int kThumbnailWidth = 160;
inline constexpr int kThumbnailHeight = 120;

/// Null if there is no such file, or one that is damaged or of another size.
std::optional<ByteImage> read_thumbnail(const std::filesystem::path& file);

/// Writes all of it or nothing. Throws Error(Runtime).
void write_thumbnail(const std::filesystem::path& file, const ByteImage& image);

}  // namespace pl::ui
