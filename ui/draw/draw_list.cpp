#include "ui/draw/draw_list.h"

#include <algorithm>
#include <cmath>

#include "core/scene/pack_scene.h"

namespace pl::ui {
namespace {

/// Liang-Barsky: the part of a line inside a rectangle.
std::optional<std::array<Vec2f, 2>> inside(const Rect& rect, Vec2f from, Vec2f to) {
    const Vec2f d = to - from;
    const float steps[4] = {-d.x, d.x, -d.y, d.y};
    const float rooms[4] = {from.x - rect.x, rect.x + rect.width - from.x, from.y - rect.y,
                            rect.y + rect.height - from.y};
    float first = 0.0f;
    float last = 1.0f;
    for (int i = 0; i < 4; ++i) {
        if (steps[i] == 0.0f && rooms[i] < 0.0f) return std::nullopt;
        if (steps[i] < 0.0f) first = std::max(first, rooms[i] / steps[i]);
        if (steps[i] > 0.0f) last = std::min(last, rooms[i] / steps[i]);
    }
    if (!(first <= last)) return std::nullopt;
    return std::array{from + first * d, from + last * d};
}

/// Near distance of drawing, as a share of the distance from eye to target.
constexpr float kNearShare = 1.0e-4f;

}  // namespace

Projection::Projection(const CameraDescription& camera, int width, int height, const Rect& image)
    : camera_(make_camera(camera, width, height)), image_(image),
      near_(kNearShare * glm::length(camera.target - camera.eye)) {}

float Projection::depth_of(Vec3f position) const { return glm::dot(position - camera_.eye, camera_.axis); }

std::optional<std::array<Vec2f, 2>> Projection::clipped(Vec3f from, Vec3f to) const {
    const float a = depth_of(from);
    const float b = depth_of(to);
    const float near = 2.0f * near_;  // rounding must not bring the cut behind the near distance
    if (!(std::max(a, b) > near)) return std::nullopt;
    const Vec3f cut = glm::mix(from, to, (near - a) / (b - a));
    const auto start = (*this)(a < near ? cut : from);
    const auto end = (*this)(b < near ? cut : to);
    return start && end ? inside(image_, start->window, end->window) : std::nullopt;
}

float Projection::pixels_of(float length, float depth) const {
    return 0.5f * image_.width * length / (glm::length(camera_.right) * std::max(depth, near_));
}

bool Projection::may_show(Vec3f center, float radius) const {
    const auto point = (*this)(center);
    if (!point) return depth_of(center) + radius > near_;
    // A sphere reaches somewhat farther than its radius at the depth of its middle.
    const float reach = 1.5f * pixels_of(radius, point->depth);
    return point->window.x > image_.x - reach && point->window.y > image_.y - reach &&
           point->window.x < image_.x + image_.width + reach && point->window.y < image_.y + image_.height + reach;
}

std::optional<Projection::Point> Projection::operator()(Vec3f position) const {
    const FilmPosition found = film_position(camera_, position, {image_.width, image_.height});
    if (!(found.depth > near_)) return std::nullopt;
    return Point{{image_.x + found.film.x, image_.y + found.film.y}, found.depth};
}

Vec2f PassScale::place(const Rect& rect, double passes, double value) const {
    const double x = std::log(std::max(passes, 1.0) / first) / std::log(last / first);
    const double y = value / top;
    return {rect.x + rect.width * static_cast<float>(std::clamp(x, 0.0, 1.0)),
            rect.y + rect.height * (1.0f - static_cast<float>(std::clamp(y, 0.0, 1.0)))};
}

PassScale scale_of(std::span<const PassPoint> points, double least_top) {
    PassScale scale{.first = 1.0, .last = 1.0, .top = least_top};
    if (!points.empty()) scale.first = std::max(std::ranges::min(points, {}, &PassPoint::passes).passes, 1.0);
    for (const PassPoint& point : points) {
        scale.last = std::max(scale.last, point.passes);
        scale.top = std::max(scale.top, point.value);
    }
    scale.last = std::max(scale.last, 1.01 * scale.first);
    scale.top = scale.top > 0.0 ? 1.1 * scale.top : 1.0;
    return scale;
}

}  // namespace pl::ui
