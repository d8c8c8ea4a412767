// Small convex polygons that are cut by lines.
#pragma once

#include <array>

#include <glm/glm.hpp>

namespace pl {

using Vec2d = glm::dvec2;

/// Convex; may shrink to a line or a point, or be empty.
class Polygon {
public:
    Polygon() = default;
    static Polygon rectangle(Vec2d low, Vec2d high) {
        Polygon polygon;
        for (const Vec2d p : {low, Vec2d{high.x, low.y}, high, Vec2d{low.x, high.y}}) polygon.add(p);
        return polygon;
    }

    bool empty() const { return count_ == 0; }
    const Vec2d* begin() const { return points_.data(); }
    const Vec2d* end() const { return points_.data() + count_; }

    /// Keeps the part with dot(n, p) <= limit. A polygon with no room for another corner may keep more.
    void clip(Vec2d n, double limit) {
        std::array<double, kCapacity> beyond;
        int outside = 0;
        for (int i = 0; i < count_; ++i) {
            beyond[i] = n.x * points_[i].x + n.y * points_[i].y - limit;
            outside += beyond[i] > 0.0 ? 1 : 0;
        }
        if (outside == 0 || (outside < count_ && count_ == kCapacity)) return;
        Polygon kept;
        for (int i = 0; i < count_ && outside < count_; ++i) {
            const int next = i + 1 < count_ ? i + 1 : 0;
            if (!(beyond[i] > 0.0)) kept.add(points_[i]);
            if ((beyond[i] > 0.0) != (beyond[next] > 0.0))
                kept.add(points_[i] + (points_[next] - points_[i]) * (beyond[i] / (beyond[i] - beyond[next])));
        }
        *this = kept;
    }

private:
    static constexpr int kCapacity = 16;

    void add(Vec2d point) { points_[static_cast<std::size_t>(count_++)] = point; }

    std::array<Vec2d, kCapacity> points_;
    int count_ = 0;
};

}  // namespace pl
