// Shapes in scene space that are drawn over the picture, as data that can be tested without a window. They are no part
// of the scene.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/kernel/scene/camera.h"
#include "core/scene/description.h"

namespace pl {

/// Part of the window, in pixels from its top left corner.
struct Rect {
    float x = 0.0f;
    float y = 0.0f;
    float width = 0.0f;
    float height = 0.0f;

    bool contains(Vec2f p) const { return p.x >= x && p.y >= y && p.x < x + width && p.y < y + height; }
    Vec2f center() const { return {x + 0.5f * width, y + 0.5f * height}; }
};

/// From the scene to the window: the exact inverse of generate_ray for a picture that fills `image`.
class Projection {
public:
    /// `width` and `height` are those of the picture, not of `image`.
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

/// Colors are 0xAABBGGRR, as in Dear ImGui.
class DrawList {
public:
    struct Shape {
        enum class Kind { Fan, Line };
        Kind kind;
        std::uint32_t first;  ///< of points
        std::uint32_t count;
        std::uint32_t color;
        float width_px;  ///< of lines
    };

    /// A polygon that is star-shaped around its first point, which is not on the border.
    void add_fan(std::span<const Vec3f> center_and_border, std::uint32_t color);
    void add_line(Vec3f from, Vec3f to, std::uint32_t color, float width_px);
    void clear();

    std::span<const Vec3f> points() const { return points_; }
    std::span<const Shape> shapes() const { return shapes_; }

private:
    std::vector<Vec3f> points_;
    std::vector<Shape> shapes_;
};

/// The shapes in the window, farthest first. Shapes that reach behind the camera are omitted.
struct ProjectedShapes {
    std::vector<Vec2f> points;
    std::vector<DrawList::Shape> shapes;
};
ProjectedShapes project(const DrawList& list, const Projection& projection);

}  // namespace pl
