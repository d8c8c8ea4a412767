// The hemisphere of a volume as a disc, turned so that up in the scene is up on the disc. Window and pictures of `inspect` share it.
#pragma once

#include <optional>

#include "core/kernel/base/frame.h"
#include "core/scene/description.h"

namespace pl {

/// Unit direction above a point of the unit disk.
inline Vec3f lift_to_hemisphere(Vec2f disk) {
    return {disk.x, disk.y, safe_sqrt(1.0f - disk.x * disk.x - disk.y * disk.y)};
}

/// A disc is the hemisphere seen against its normal, as from a camera in front of the surface, with directions projected onto the
/// surface: equal areas are equal shares of irradiance. Its points (x right, y up) are in the unit disk. Cells lie in the frame
/// make_frame(normal), which is turned against the disc's.
class DiscFrame {
public:
    DiscFrame(Vec3f normal, const CameraDescription& camera);

    /// Whether up on the disc is the scene's up; else it is up in the picture: on floors and ceilings, where the scene's up is the center or
    /// behind it.
    bool up_is_scene() const { return up_is_scene_; }
    Vec3f right() const { return frame_.x; }
    Vec3f up() const { return frame_.y; }

    /// From points of the cells' disk, see square_to_disk(), and back.
    Vec2f from_cells(Vec2f disk) const;
    Vec2f to_cells(Vec2f disc) const;

    /// Of a unit direction in scene space; empty below the surface.
    std::optional<Vec2f> point_of(Vec3f direction) const;
    /// Unit direction in scene space.
    Vec3f direction_of(Vec2f disc) const { return frame_.to_world(lift_to_hemisphere(disc)); }

private:
    Frame frame_;
    Vec2f turn_{1.0f, 0.0f};  ///< cosine and sine of the angle from the cells' frame to the disc's
    bool up_is_scene_ = true;
};

}  // namespace pl
