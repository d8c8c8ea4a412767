#include "core/fields/disc_frame.h"

#include <cmath>

namespace pl {
namespace {

/// Sine of the angle between normal and the scene's up below which up on the disc follows the picture: 8 degrees.
constexpr float kLeastSine = 0.14f;

Vec3f along_surface(Vec3f direction, Vec3f normal) { return direction - glm::dot(direction, normal) * normal; }

bool has_length(Vec3f v, float least) { return glm::length(v) > least; }

/// Up in the picture, projected onto a surface that the scene's up is normal to. A camera that looks straight ahead sees floor and
/// ceiling edge-on: there it is the limit of looking down at the floor, or up at the ceiling.
Vec3f picture_up(Vec3f normal, const CameraDescription& camera) {
    const Vec3f forward = camera.target - camera.eye;
    const Vec3f ahead = along_surface(forward, normal);
    const float side = glm::dot(normal, camera.up) >= 0.0f ? 1.0f : -1.0f;
    if (has_length(ahead, 1.0e-3f * glm::length(forward))) return side * ahead;
    const Vec3f up = along_surface(camera.up, normal);
    return has_length(up, 0.0f) ? up : make_frame(normal).y;
}

}  // namespace

DiscFrame::DiscFrame(Vec3f normal, const CameraDescription& camera) {
    Vec3f up = along_surface(glm::normalize(camera.up), normal);
    if (!has_length(up, kLeastSine)) {
        up_is_scene_ = false;
        up = picture_up(normal, camera);
    }
    const Vec3f y = glm::normalize(up);
    frame_ = {glm::cross(y, normal), y, normal};
    const Frame cells = make_frame(normal);
    turn_ = {glm::dot(frame_.x, cells.x), glm::dot(frame_.x, cells.y)};
}

Vec2f DiscFrame::from_cells(Vec2f disk) const {
    return {turn_.x * disk.x + turn_.y * disk.y, turn_.x * disk.y - turn_.y * disk.x};
}

Vec2f DiscFrame::to_cells(Vec2f disc) const {
    return {turn_.x * disc.x - turn_.y * disc.y, turn_.y * disc.x + turn_.x * disc.y};
}

std::optional<Vec2f> DiscFrame::point_of(Vec3f direction) const {
    const Vec3f local = frame_.to_local(direction);
    if (local.z <= 0.0f) return std::nullopt;
    return Vec2f{local.x, local.y};
}

}  // namespace pl
