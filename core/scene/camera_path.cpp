#include "core/scene/camera_path.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include "core/base/error.h"

namespace pl {
namespace {

/// Below this cosine of its pitch a direction has no yaw.
constexpr float kUpright = 1.0e-4f;

/// Uniform Catmull-Rom between b and c.
template <class T>
T spline(const T& a, const T& b, const T& c, const T& d, float t) {
    const T linear = c - a;
    const T square = 2.0f * a - 5.0f * b + 4.0f * c - d;
    const T cube = 3.0f * (b - c) + d - a;
    return b + 0.5f * t * (linear + t * (square + t * cube));
}

/// The spline through `count` values between values `index` and `index + 1`. Beyond its ends it goes on straight.
template <class Value>
auto spline_at(const Value& value, std::size_t count, std::size_t index, float t) {
    const auto b = value(index);
    const auto c = value(index + 1);
    const auto a = index > 0 ? value(index - 1) : 2.0f * b - c;
    const auto d = index + 2 < count ? value(index + 2) : 2.0f * c - b;
    return spline(a, b, c, d, t);
}

float log_mix(float a, float b, float t) { return std::exp(glm::mix(std::log(a), std::log(b), t)); }

/// Any unit vector perpendicular to a unit one.
glm::vec3 perpendicular(glm::vec3 axis) {
    const glm::vec3 other = std::fabs(axis.x) < 0.9f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 0.0f, 1.0f);
    return glm::normalize(other - glm::dot(other, axis) * axis);
}

void require_path(const std::vector<CameraDescription>& cameras) {
    if (cameras.size() < CameraPath::kFewest)
        throw Error(ErrorKind::Usage, fmt::format("a camera path: expected at least {} cameras, got {}",
                                                  CameraPath::kFewest, cameras.size()));
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        if (!(glm::length(cameras[i].target - cameras[i].eye) > 0.0f))
            throw Error(
                ErrorKind::Usage,
                fmt::format("camera {} of a path: expected a target away from the eye, got the same point for "
                            "both",
                            i + 1));
        if (!(glm::length(cameras[i].up) > 0.0f))
            throw Error(ErrorKind::Usage,
                        fmt::format("camera {} of a path: expected a direction as up, got 0,0,0", i + 1));
    }
}

}  // namespace

CameraPath::CameraPath(std::vector<CameraDescription> cameras) : cameras_(std::move(cameras)) {
    require_path(cameras_);
    up_ = glm::normalize(cameras_.front().up);
    ahead_ = perpendicular(up_);
    sideways_ = glm::cross(up_, ahead_);
    for (const CameraDescription& camera : cameras_) {
        const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
        const float along = glm::dot(forward, ahead_);
        const float aside = glm::dot(forward, sideways_);
        Angles angles = angles_.empty() ? Angles{} : angles_.back();
        angles.pitch = std::asin(std::clamp(glm::dot(forward, up_), -1.0f, 1.0f));
        if (std::hypot(along, aside) > kUpright) {
            const float turn = std::atan2(aside, along) - angles.yaw;
            angles.yaw += turn - glm::two_pi<float>() * std::round(turn / glm::two_pi<float>());
        }
        angles_.push_back(angles);
    }
}

glm::vec3 CameraPath::direction(Angles angles) const {
    const glm::vec3 level = std::cos(angles.yaw) * ahead_ + std::sin(angles.yaw) * sideways_;
    return std::cos(angles.pitch) * level + std::sin(angles.pitch) * up_;
}

CameraDescription CameraPath::between(std::size_t index, float share) const {
    const CameraDescription& from = cameras_[index];
    const CameraDescription& to = cameras_[index + 1];
    const auto spline_of = [&](const auto& value) { return spline_at(value, cameras_.size(), index, share); };
    Angles angles{.yaw = spline_of([&](std::size_t i) { return angles_[i].yaw; }),
                  .pitch = spline_of([&](std::size_t i) { return angles_[i].pitch; })};
    angles.pitch = std::clamp(angles.pitch, -glm::half_pi<float>(), glm::half_pi<float>());

    CameraDescription camera = from;
    camera.eye = spline_of([&](std::size_t i) { return cameras_[i].eye; });
    const float distance = log_mix(glm::length(from.target - from.eye), glm::length(to.target - to.eye), share);
    camera.target = camera.eye + distance * direction(angles);
    const glm::vec3 up = glm::mix(glm::normalize(from.up), glm::normalize(to.up), share);
    camera.up = glm::length(up) > kUpright ? glm::normalize(up) : from.up;  // opposite ones have no mean
    camera.fov_deg = glm::mix(from.fov_deg, to.fov_deg, share);
    camera.aperture_radius = glm::mix(from.aperture_radius, to.aperture_radius, share);
    camera.shift = glm::mix(from.shift, to.shift, share);
    camera.focus_distance = log_mix(from.focus_distance, to.focus_distance, share);
    return camera;
}

CameraDescription CameraPath::at(double position) const {
    const double last = static_cast<double>(cameras_.size() - 1);
    const double inside = std::clamp(position, 0.0, last);
    const auto index = static_cast<std::size_t>(inside);
    const auto share = static_cast<float>(inside - static_cast<double>(index));
    return share > 0.0f ? between(index, share) : cameras_[index];
}

CameraDescription CameraPath::frame(int index, int frames) const {
    const std::size_t steps = static_cast<std::size_t>(index) * (cameras_.size() - 1);
    const auto spaces = static_cast<std::size_t>(frames - 1);
    const std::size_t from = steps / spaces;
    if (steps % spaces == 0) return cameras_[from];
    return between(from, static_cast<float>(steps % spaces) / static_cast<float>(spaces));
}

}  // namespace pl
