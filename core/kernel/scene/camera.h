// Pinhole camera.
#pragma once

#include "core/kernel/geometry/ray.h"

namespace pl {

/// The image plane at distance 1: `right` and `up` span half of its width and height.
struct PinholeCamera {
    Vec3f eye{0.0f};
    Vec3f forward{0.0f, 0.0f, -1.0f};
    Vec3f right{1.0f, 0.0f, 0.0f};
    Vec3f up{0.0f, 1.0f, 0.0f};
};

/// Ray through a point of the film, in pixels from the top left corner. The direction is unit.
PL_HD inline Ray generate_ray(const PinholeCamera& camera, Vec2f film, Vec2f resolution) {
    const float x = 2.0f * (film.x / resolution.x) - 1.0f;
    const float y = 1.0f - 2.0f * (film.y / resolution.y);
    return {.origin = camera.eye, .direction = glm::normalize(camera.forward + x * camera.right + y * camera.up)};
}

}  // namespace pl
