// The learned hemisphere of a radiance volume as a picture: equal-area discs with a legend.
#pragma once

#include <string>

#include "core/fields/inspect_field.h"
#include "core/io/image.h"
#include "core/scene/description.h"

namespace pl {

/// One large disc of the learned radiance, two small ones of probability and visits, with their captions, in the DiscFrame of
/// volume and camera. Colors as in the window: each disc over its own values, logarithmic.
ByteImage draw_hemisphere(const VolumeInspection& volume, const CameraDescription& camera, const std::string& title);

/// The lines above all discs: title, volume, position, and the world directions of the disc's axes.
std::vector<std::string> hemisphere_lines(const VolumeInspection& volume, const CameraDescription& camera,
                                          const std::string& title);

}  // namespace pl
