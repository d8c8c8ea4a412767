#include "ui/model/camera_motion.h"

namespace pl::ui {

void CameraMotion::update(double seconds) {
    now_ = seconds;
    if (!moving_ || now_ < moving_until_) return;
    moving_ = false;
    worker_.set_moving(false);
}

void CameraMotion::touch() {
    moving_until_ = now_ + kRestSeconds;
    if (moving_) return;
    moving_ = true;
    worker_.set_moving(true);
}

void CameraMotion::submit() {
    touch();
    generation_ = worker_.submit(EditCamera{controls_.camera()});
}

void CameraMotion::fly(const MoveKeys& keys, double seconds) {
    if (controls_.move(keys, seconds)) submit();
}

void CameraMotion::look(Vec2f pixels) {
    if (pixels.x == 0.0f && pixels.y == 0.0f) return;
    controls_.look(pixels);
    submit();
}

void CameraMotion::orbit(Vec2f pixels, Vec3f center) {
    if (pixels.x == 0.0f && pixels.y == 0.0f) return;
    controls_.orbit(pixels, center);
    submit();
}

void CameraMotion::pan(Vec2f pixels, Vec3f at, float height_px) {
    if (pixels.x == 0.0f && pixels.y == 0.0f) return;
    const CameraDescription& camera = controls_.camera();
    const Vec3f ahead = camera.target - camera.eye;
    const float depth = glm::dot(at - camera.eye, glm::normalize(ahead));
    controls_.pan(pixels, depth > 0.0f ? depth : glm::length(ahead), height_px);
    submit();
}

void CameraMotion::look_at(Vec3f position) {
    CameraDescription camera = controls_.camera();
    const float distance = glm::length(position - camera.eye);
    if (!(distance > 0.0f)) return;
    camera.target = position;
    if (camera.aperture_radius > 0.0f) camera.focus_distance = distance;
    set(camera);
}

void CameraMotion::change_speed(float notches) {
    constexpr double kShownSeconds = 1.5;
    controls_.change_speed(notches);
    speed_shown_until_ = now_ + kShownSeconds;
}

void CameraMotion::go_home() {
    controls_.go_home();
    submit();
}

void CameraMotion::set(const CameraDescription& camera) {
    controls_.set_camera(camera);
    submit();
}

void CameraMotion::focus_on(Vec3f position) {
    CameraDescription camera = controls_.camera();
    const Vec3f forward = glm::normalize(camera.target - camera.eye);
    const float distance = glm::dot(position - camera.eye, forward);
    if (!(distance > 0.0f)) return;
    camera.focus_distance = distance;
    set(camera);
}

void CameraMotion::open(const CameraDescription& home, float scene_diagonal, bool keep) {
    const CameraDescription camera = keep ? controls_.camera() : home;
    controls_ = CameraControls(home, scene_diagonal);
    controls_.set_camera(camera);
}

}  // namespace pl::ui
