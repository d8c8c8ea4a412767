// Flying and looking around, without window and clock.
#pragma once

#include "core/kernel/base/math.h"
#include "core/scene/description.h"

namespace pl::ui {

/// Directions of the held keys; each in [-1, 1].
struct MoveKeys {
    float forward = 0.0f;
    float right = 0.0f;
    float up = 0.0f;  ///< along the camera's up axis, not the image's
    float speed_factor = 1.0f;

    bool any() const { return forward != 0.0f || right != 0.0f || up != 0.0f; }
};

class CameraControls {
public:
    /// A slow frame must not make the camera jump: longer steps are cut.
    static constexpr double kLongestStepSeconds = 0.1;
    static constexpr float kLookDegPerPixel = 0.2f;
    static constexpr float kOrbitDegPerPixel = 0.4f;
    static constexpr float kMaxPitchDeg = 89.0f;

    /// `scene_diagonal` > 0 sets the speed: a fifth of it per second.
    CameraControls(const CameraDescription& home, float scene_diagonal);

    const CameraDescription& camera() const { return camera_; }
    void set_camera(const CameraDescription& camera) { camera_ = camera; }
    void go_home() { camera_ = home_; }

    /// Straight motion without inertia, independent of the frame rate. True if the camera moved.
    bool move(const MoveKeys& keys, double seconds);

    /// Turns by a mouse movement in pixels; right and down are positive. The distance to the target is kept.
    void look(Vec2f pixels);

    /// Turns the camera around `center` by a mouse movement in pixels, as if the scene was turned by it: the center keeps its
    /// distance and its place in the picture. The horizon stays level.
    void orbit(Vec2f pixels, Vec3f center);
    /// Moves the camera across its view, so that a point at `depth` along the view follows a mouse movement in pixels.
    /// `height_px` is the height of the picture in the window.
    void pan(Vec2f pixels, float depth, float height_px);

    /// Scene units per second, from diagonal/1000 to 10 diagonals.
    float speed() const { return speed_; }
    void change_speed(float notches);

private:
    CameraDescription home_;
    CameraDescription camera_;
    float diagonal_;
    float speed_;
};

}  // namespace pl::ui
