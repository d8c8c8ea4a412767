// The camera of the window: flying, looking around, the edits that follow, and when motion ends.
#pragma once

#include "core/kernel/base/math.h"
#include "core/scene/description.h"
#include "ui/worker/render_worker.h"

namespace pl::ui {

// Flying and looking around, without window and clock.

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

class CameraMotion {
public:
    /// Seconds without input after which the camera is at rest, and the picture is rendered at its full size again.
    static constexpr double kRestSeconds = 0.1;

    /// `given` is the camera that the viewer was started with: the defaults of the lens.
    CameraMotion(const CameraDescription& given, const CameraControls& controls, RenderWorker& worker)
        : given_(given), controls_(controls), worker_(worker) {}

    /// Once per frame of the window, with its clock.
    void update(double seconds);

    const CameraDescription& camera() const { return controls_.camera(); }
    const CameraDescription& given() const { return given_; }
    float speed() const { return controls_.speed(); }  ///< in scene units per second
    bool is_speed_shown() const { return now_ < speed_shown_until_; }
    bool is_moving() const { return moving_; }
    /// Number of the newest camera edit; 0 before the first.
    std::uint64_t generation() const { return generation_; }

    void fly(const MoveKeys& keys, double seconds);
    void look(Vec2f pixels);
    void orbit(Vec2f pixels, Vec3f center);
    /// See CameraControls::pan().
    void pan(Vec2f pixels, Vec3f at, float height_px);
    void change_speed(float notches);
    void go_home();
    void set(const CameraDescription& camera);
    /// Sets the focus distance to a point in front of the camera.
    void focus_on(Vec3f position);
    /// Looks at a point; a lens is focused on it.
    void look_at(Vec3f position);
    /// Another scene: its own camera is home, and the camera stays if `keep` is set.
    void open(const CameraDescription& home, float scene_diagonal, bool keep);
    /// The picture changes with every frame of the window, as in motion: it may be coarse until the changes end.
    void touch();

private:
    void submit();

    CameraDescription given_;
    CameraControls controls_;
    RenderWorker& worker_;
    double now_ = 0.0;
    bool moving_ = false;
    double moving_until_ = -1.0;
    double speed_shown_until_ = 0.0;
    std::uint64_t generation_ = 0;
};

}  // namespace pl::ui
