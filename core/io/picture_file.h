// Picture files of snapshots: linear values, or display values.
#pragma once

#include <filesystem>

#include "core/io/image.h"
#include "core/session/settings.h"
#include "core/session/snapshot.h"

namespace pl {

/// Display values of a picture: scaled by shown_range(), tone mapped, sRGB. Exposure and curve apply to radiance
/// only: views of data, such as normals, are shown as they are, and heat maps in the colors of heat_color().
ByteImage display_image(const Snapshot& snapshot, const DisplaySettings& display);

/// The bytes of a file of this kind: EXR or PFM linear, PNG as display_image(). PFM has no metadata. Throws Error(Runtime) if the
/// encoder fails.
std::string encode_picture(ImageKind kind, const Snapshot& snapshot, const DisplaySettings& display,
                           const ImageMetadata& metadata);

/// Writes .exr or .pfm linear, .png as display_image(). Throws Error: Usage for another suffix, Runtime.
void save_picture(const std::filesystem::path& path, const Snapshot& snapshot, const DisplaySettings& display,
                  const ImageMetadata& metadata);

/// Throws Error(Runtime) unless a file of this name can be made or replaced. Leaves no trace.
void require_writable(const std::filesystem::path& path);

// Names of the files of a sequence: the pictures of a camera path, in one folder.

/// FOLDER/frame_0001.png for index 0, with at least four digits; its suffix tells the kind.
std::filesystem::path frame_file(const std::filesystem::path& folder, int index, ImageKind kind);

}  // namespace pl
