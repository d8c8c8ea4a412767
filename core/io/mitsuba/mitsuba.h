// Loader of Mitsuba scenes: XML of the versions 0.x and 3.
#pragma once

#include <filesystem>

#include <glm/glm.hpp>

#include "core/io/load_settings.h"
#include "core/io/mitsuba/xml_file.h"
#include "core/scene/description.h"

namespace pl {

// Media of Mitsuba as the absorption of glass.

/// Absorption per length inside of glass, from a `medium` element of the type homogeneous, which scatters nothing.
/// Other media are noted and absorb nothing. [Mitsuba 3 and 0.6, homogeneous]
glm::vec3 mitsuba_absorption(const MitsubaObject& medium);

/// Reads shapes, groups of them by their instances (see MitsubaInstances), surfaces, textures, emitters, camera and size of the picture;
/// the caller sets the name. `up` is the up vector of the camera. The first sensor becomes the first of
/// SceneDescription::cameras. The depth of the integrator becomes the preset max-depth. Content without a counterpart
/// is told once for each kind, as is every property that is not read.
/// Throws Error(Input) with file and line, see MitsubaFile, and Error(Usage) for LoadSettings::parameters that the files do not have.
SceneDescription load_mitsuba(const std::filesystem::path& path, const LoadSettings& asked = {});

}  // namespace pl
