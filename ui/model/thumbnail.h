// Small pictures of scenes: rendered, and kept as files by the content of the scene.
#pragma once

#include <filesystem>
#include <optional>

#include "core/io/image.h"
#include "core/scene/description.h"
#include "core/session/backend.h"

namespace pl::ui {

inline constexpr int kThumbnailWidth = 160;
inline constexpr int kThumbnailHeight = 120;

/// "0123456789abcdef.png": a hash of all that decides the picture.
std::string thumbnail_name(const SceneDescription& scene);

/// Null if there is no such file, or one that is damaged or of another size.
std::optional<ByteImage> read_thumbnail(const std::filesystem::path& file);

/// Writes all of it or nothing. Throws Error(Runtime).
void write_thumbnail(const std::filesystem::path& file, const ByteImage& image);

/// By the scene's own camera, on the CPU. Empty if it was stopped. Throws Error.
std::optional<ByteImage> render_thumbnail(std::shared_ptr<const SceneDescription> scene,
                                          const BackendFactory& make_backend, bool is_draft, const StopFlag* stop);

}  // namespace pl::ui
