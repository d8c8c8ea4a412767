// Camera files: --camera FILE.
#pragma once

#include <filesystem>

#include "app/option_values.h"

namespace pl {

/// Reads {"eye": [x,y,z], "target": [x,y,z], "up": [x,y,z], "fov_deg": vertical, "aperture_radius": r,
/// "focus_distance": d}; every member may be missing. Throws Error(Input) with file and line.
CameraChoice load_camera_file(const std::filesystem::path& path);

}  // namespace pl
