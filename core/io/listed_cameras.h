// The cameras that a file lists, and the choice among them.
#pragma once

#include <string>

#include "core/scene/description.h"

namespace pl {

/// Value of the setting `size` for pictures of this width over height.
std::string size_of_aspect(float aspect);

/// The first listed camera; without any that of frame_camera(). Expects SceneDescription::up and a triangle.
void set_default_camera(SceneDescription& scene);

/// Sets the camera that is asked for by name or number; if nothing is asked, the camera stays. The shape of the picture of a listed
/// camera becomes the setting `size`, unless the scene has one.
/// Throws Error(Usage) if there is no such camera.
void choose_camera(const std::string& asked, SceneDescription& scene);

}  // namespace pl
