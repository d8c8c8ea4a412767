// The camera of the window: flying, looking around, the edits that follow, and when motion ends.
#pragma once

#include "ui/model/camera_controls.h"
#include "ui/worker/render_worker.h"

namespace pl::ui {

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
