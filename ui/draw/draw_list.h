// Rectangles of the window, and the projection from the scene into them, by which shapes are drawn over the picture. They are no
// part of the scene.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/kernel/scene/camera.h"
#include "core/scene/description.h"

namespace pl::ui {

/// Part of the window, in pixels from its top left corner.
struct Rect {
    float x = 0.0f;
    float y = 0.0f;
    float width = 0.0f;
    float height = 0.0f;

    bool contains(Vec2f p) const { return p.x >= x && p.y >= y && p.x < x + width && p.y < y + height; }
    Vec2f center() const { return {x + 0.5f * width, y + 0.5f * height}; }

    friend bool operator==(const Rect&, const Rect&) = default;
};

/// From the scene to the window: the exact inverse of generate_ray for a picture that fills `image`.
class Projection {
public:
    /// `width` and `height`: of the picture, not of `image`.
    Projection(const CameraDescription& camera, int width, int height, const Rect& image);

    struct Point {
        Vec2f window;
        float depth;  ///< along the view direction, in scene units
    };
    /// Empty for points that do not lie in front of the camera.
    std::optional<Point> operator()(Vec3f position) const;

    /// The part of a straight line that is in front of the camera and inside the picture, in the window; empty if none is.
    std::optional<std::array<Vec2f, 2>> clipped(Vec3f from, Vec3f to) const;

    /// Pixels of a length across the viewing direction at a depth.
    float pixels_of(float length, float depth) const;
    /// Whether a sphere may be seen: false only for spheres outside of the picture.
    bool may_show(Vec3f center, float radius) const;

    Vec3f eye() const { return camera_.eye; }

private:
    float depth_of(Vec3f position) const;

    Camera camera_;
    Rect image_;
    float near_;
};

// A small curve over passes, as data that can be tested without a window.

struct PassPoint {
    double passes = 1.0;  ///< at least 1
    double value = 0.0;
    double low = 0.0;  ///< interval of the value
    double high = 0.0;
};

/// Logarithmic in passes, linear in values from 0 on.
struct PassScale {
    double first = 1.0;  ///< passes at the left end
    double last = 2.0;   ///< at the right end, larger than `first`
    double top = 1.0;    ///< value at the top

    Vec2f place(const Rect& rect, double passes, double value) const;
};

/// The scale that shows all points, of several curves one after the other. `least_top`: a value that is shown in any case.
PassScale scale_of(std::span<const PassPoint> points, double least_top);

}  // namespace pl::ui
