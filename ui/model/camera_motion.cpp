#include "ui/model/camera_motion.h"

#include <algorithm>

#include <glm/gtc/quaternion.hpp>

namespace pl::ui {
namespace {

constexpr float kSpeedPerNotch = 1.25f;

float radians(float deg) { return deg * (kPi / 180.0f); }

/// Unit up axis; a zero one becomes +y.
Vec3f up_axis(const CameraDescription& camera) {
    const float length = glm::length(camera.up);
    return length > 0.0f ? camera.up / length : Vec3f{0.0f, 1.0f, 0.0f};
}

Vec3f view_direction(const CameraDescription& camera) {
    const Vec3f d = camera.target - camera.eye;
    const float length = glm::length(d);
    return length > 0.0f ? d / length : Vec3f{0.0f, 0.0f, -1.0f};
}

/// Unit component of `direction` perpendicular to the unit `axis`; any such vector if it vanishes.
Vec3f horizontal_part(Vec3f direction, Vec3f axis) {
    Vec3f flat = direction - glm::dot(direction, axis) * axis;
    if (glm::dot(flat, flat) < 1.0e-8f) {
        const Vec3f other = std::fabs(axis.x) < 0.9f ? Vec3f{1.0f, 0.0f, 0.0f} : Vec3f{0.0f, 0.0f, 1.0f};
        flat = other - glm::dot(other, axis) * axis;
    }
    return glm::normalize(flat);
}

}  // namespace

CameraControls::CameraControls(const CameraDescription& home, float scene_diagonal)
    : home_(home), camera_(home), diagonal_(scene_diagonal > 0.0f ? scene_diagonal : 1.0f), speed_(diagonal_ / 5.0f) {
}

bool CameraControls::move(const MoveKeys& keys, double seconds) {
    if (!keys.any() || !(seconds > 0.0)) return false;
    const Vec3f up = up_axis(camera_);
    const Vec3f forward = view_direction(camera_);
    const Vec3f right = glm::cross(horizontal_part(forward, up), up);
    Vec3f direction = keys.forward * forward + keys.right * right + keys.up * up;
    const float length = glm::length(direction);
    if (!(length > 0.0f)) return false;
    direction /= std::max(length, 1.0f);
    const double step = std::min(seconds, kLongestStepSeconds) * static_cast<double>(speed_ * keys.speed_factor);
    const Vec3f shift = direction * static_cast<float>(step);
    camera_.eye += shift;
    camera_.target += shift;
    return true;
}

void CameraControls::look(Vec2f pixels) {
    const Vec3f up = up_axis(camera_);
    const Vec3f forward = view_direction(camera_);
    const float distance = std::max(glm::length(camera_.target - camera_.eye), 1.0e-6f * diagonal_);
    // Narrow fields of view turn more slowly: the picture moves by about the same number of pixels.
    const float deg_per_pixel = kLookDegPerPixel * std::clamp(camera_.fov_deg / 40.0f, 0.05f, 1.0f);

    const float yaw = -radians(pixels.x * deg_per_pixel);
    const Vec3f flat = horizontal_part(forward, up);
    const Vec3f turned = std::cos(yaw) * flat + std::sin(yaw) * glm::cross(up, flat);

    const float limit = radians(kMaxPitchDeg);
    const float pitch = std::asin(std::clamp(glm::dot(forward, up), -1.0f, 1.0f));
    const float lifted = std::clamp(pitch - radians(pixels.y * deg_per_pixel), -limit, limit);
    camera_.target = camera_.eye + distance * (std::cos(lifted) * turned + std::sin(lifted) * up);
}

void CameraControls::orbit(Vec2f pixels, Vec3f center) {
    const Vec3f up = up_axis(camera_);
    const Vec3f forward = view_direction(camera_);
    const Vec3f flat = horizontal_part(forward, up);
    const Vec3f right = glm::cross(flat, up);
    const float limit = radians(kMaxPitchDeg);
    const float pitch = std::asin(std::clamp(glm::dot(forward, up), -1.0f, 1.0f));
    const float lift = std::clamp(pitch - radians(pixels.y * kOrbitDegPerPixel), -limit, limit) - pitch;
    const glm::quat turn = glm::angleAxis(-radians(pixels.x * kOrbitDegPerPixel), up) * glm::angleAxis(lift, right);
    camera_.eye = center + turn * (camera_.eye - center);
    camera_.target = center + turn * (camera_.target - center);
}

void CameraControls::pan(Vec2f pixels, float depth, float height_px) {
    const Vec3f forward = view_direction(camera_);
    const Vec3f right = glm::cross(horizontal_part(forward, up_axis(camera_)), up_axis(camera_));
    const Vec3f above = glm::cross(right, forward);
    const float per_pixel = 2.0f * depth * std::tan(0.5f * radians(camera_.fov_deg)) / std::max(height_px, 1.0f);
    const Vec3f shift = per_pixel * (pixels.y * above - pixels.x * right);
    camera_.eye += shift;
    camera_.target += shift;
}

void CameraControls::change_speed(float notches) {
    speed_ = std::clamp(speed_ * std::pow(kSpeedPerNotch, notches), diagonal_ / 1000.0f, diagonal_ * 10.0f);
}

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
