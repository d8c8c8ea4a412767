// The camera: a pinhole or a thin lens.
#pragma once

#include "core/kernel/base/numbers.h"
#include "core/kernel/base/warp.h"
#include "core/kernel/geometry/ray.h"

namespace pl {

/// The image plane at distance 1 along the optical axis; `right` and `up` are half of the picture's width and height there. With an
/// aperture radius of 0 it is a pinhole.
struct Camera {
    Vec3f eye{0.0f};
    Vec3f axis{0.0f, 0.0f, -1.0f};    ///< unit
    Vec3f center{0.0f, 0.0f, -1.0f};  ///< from the eye to the middle of the picture, which a shift takes off the axis
    Vec3f right{1.0f, 0.0f, 0.0f};
    Vec3f up{0.0f, 1.0f, 0.0f};
    float aperture_radius = 0.0f;
    float focus_distance = 1.0f;  ///< distance of the plane of focus, along the axis
};

/// Unit direction from the eye through a point of the film, in pixels from the top left corner.
template <class N>
PL_INLINE Real3<N> camera_direction(const Camera& camera, const Real2<N>& film, Vec2f resolution) {
    const auto x = 2.0f * (film.x / resolution.x) - 1.0f;
    const auto y = 1.0f - 2.0f * (film.y / resolution.y);
    const Real3<N> center = constant_vector<N>(camera.center);
    const Real3<N> direction =
        center + scaled(constant_vector<N>(camera.right), x) + scaled(constant_vector<N>(camera.up), y);
    return scaled(direction, 1.0f / N::sqrt(dot(direction, direction)));
}
PL_HD inline Ray generate_ray(const Camera& camera, Vec2f film, Vec2f resolution) {
    return {.origin = camera.eye, .direction = pack(camera_direction(camera, unpack(film), resolution))};
}

/// A point of the scene on the film of a pinhole, in pixels from the top left corner; inverse of generate_ray().
struct FilmPosition {
    Vec2f film{0.0f};
    float depth = 0.0f;  ///< along the axis; not positive: the point is not before the camera, and has no position
};
PL_HD inline FilmPosition film_position(const Camera& camera, Vec3f point, Vec2f resolution) {
    const Vec3f away = point - camera.eye;
    const float depth = glm::dot(away, camera.axis);
    if (!(depth > 0.0f)) return {};
    const Vec3f from_center = away / depth - camera.center;
    const float x = glm::dot(from_center, camera.right) / glm::dot(camera.right, camera.right);
    const float y = glm::dot(from_center, camera.up) / glm::dot(camera.up, camera.up);
    return {{0.5f * (1.0f + x) * resolution.x, 0.5f * (1.0f - y) * resolution.y}, depth};
}

/// Thin-lens ray: from a uniform point of the aperture, u in [0,1)^2, to the point where `center`, the ray through
/// the center of the lens, meets the plane of focus.   [Kolb, Mitchell, Hanrahan 1995, "A Realistic Camera Model for
/// Computer Graphics", section 3.1]
PL_HD inline Ray through_lens(const Camera& camera, const Ray& center, Vec2f u) {
    const Vec2f disk = camera.aperture_radius * square_to_disk(u);
    const Vec3f offset = disk.x * glm::normalize(camera.right) + disk.y * glm::normalize(camera.up);
    const Vec3f focus = (camera.focus_distance / glm::dot(center.direction, camera.axis)) * center.direction;
    return {.origin = center.origin + offset, .direction = glm::normalize(focus - offset)};
}

}  // namespace pl
