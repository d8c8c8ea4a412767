#include "ui/draw/curve.h"

#include <algorithm>
#include <cmath>

namespace pl::ui {

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
