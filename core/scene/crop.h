// Cameras that show a part of a picture.
#pragma once

#include "core/scene/description.h"

namespace pl {

/// A part of a picture, in pixels, rows counted from the top.
struct CropWindow {
    float x, y;  ///< of its top left corner
    float width, height;
};

/// The camera whose whole picture is the window in the picture of `camera`, of width x height pixels: of a smaller angle, and shifted.
CameraDescription cropped(CameraDescription camera, float width, float height, const CropWindow& window);

}  // namespace pl
