// Loader of Mitsuba scenes: XML of the versions 0.x and 3.
#pragma once

#include <filesystem>

#include "core/scene/description.h"

namespace pl {

/// Reads shapes, instances as copies of theirs, surfaces, textures, emitters, camera and size of the picture; the caller sets the name. `up` is that of the camera.
/// The first sensor becomes the first of SceneDescription::cameras. Content without a counterpart is told once for each kind; integrators and
/// samplers say nothing about the scene and are passed over.
/// Throws Error(Input) with file and line, see MitsubaFile.
SceneDescription load_mitsuba(const std::filesystem::path& path);

}  // namespace pl
