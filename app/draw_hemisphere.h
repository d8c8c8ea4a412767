// The learned hemisphere of a radiance volume as a picture: equal-area discs with a legend.
#pragma once

#include <span>
#include <string>

#include "app/canvas.h"
#include "core/session/snapshot.h"

namespace pl {

/// One large disc of the learned radiance, two small ones of probability and visits, with their captions. A disc is
/// the hemisphere seen along the normal, with directions projected onto the surface: equal areas are equal shares of
/// irradiance. Local x points right and local y up; the legend gives both in world coordinates.
ByteImage draw_hemisphere(const VolumeInspection& volume, const std::string& title);

/// Color of a share in [0, 1]: dark blue, green, yellow.
Rgb share_color(float share);

}  // namespace pl
