#include "core/io/mitsuba/sensor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "core/io/line_reader.h"
#include "core/scene/crop.h"
#include "core/scene/instance_boxes.h"
#include "core/scene/instances.h"
#include "core/scene/pack_scene.h"

namespace pl {
namespace {

/// The part of a film that is rendered.
CropWindow crop_of(const MitsubaObject& film, float width, float height) {
    const float x = film.number("crop_offset_x").value_or(0.0f);
    const float y = film.number("crop_offset_y").value_or(0.0f);
    const CropWindow crop{x, y, film.number("crop_width").value_or(width - x),
                          film.number("crop_height").value_or(height - y)};
    if (!(x >= 0.0f && y >= 0.0f && crop.width >= 1.0f && crop.height >= 1.0f && x + crop.width <= width &&
          y + crop.height <= height))
        film.fail(fmt::format("expected a crop within {:.0f}x{:.0f} pixels, got {}x{} at ({}, {})", width, height,
                              crop.width, crop.height, x, y));
    return crop;
}

/// 1, or far from the origin more: floats there would turn the view to a target at 1.
double target_distance(const glm::vec3& eye) {
    constexpr double kFar = 1024.0;
    const glm::dvec3 away = glm::abs(glm::dvec3(eye));
    return std::exp2(std::ceil(std::log2(std::max({kFar, away.x, away.y, away.z}) / kFar)));
}

/// An angle of view, and the side of the picture that it spans: 'x', 'y' or 'd', the diagonal.
struct ViewAngle {
    double degrees;
    char axis;
};

/// Focal lengths refer to the diagonal of 36 x 24 mm. [Mitsuba 3, perspective]
ViewAngle angle_of(const MitsubaObject& sensor, double aspect) {
    const auto fov = sensor.number("fov");
    std::string focal = sensor.text("focal_length").value_or("50mm");
    const std::string axis = mitsuba_name(sensor.text("fov_axis").value_or("x"));
    if (!fov) {
        if (focal.ends_with("mm")) focal.resize(focal.size() - 2);
        const double length = parse_number(focal).value_or(0.0);
        if (!(length > 0.0))
            sensor.fail(
                fmt::format("'focal_length': expected millimeters above 0 such as 50mm, got {}", in_quotes(focal)));
        return {glm::degrees(2.0 * std::atan(0.5 * std::hypot(36.0, 24.0) / length)), 'd'};
    }
    const double degrees = static_cast<double>(*fov);
    if (axis == "x" || axis == "y") return {degrees, axis.front()};
    if (axis == "diagonal") return {degrees, 'd'};
    if (axis == "smaller") return {degrees, aspect > 1.0 ? 'y' : 'x'};
    if (axis == "larger") return {degrees, aspect > 1.0 ? 'x' : 'y'};
    sensor.fail(fmt::format("'fov_axis': expected x, y, diagonal, smaller or larger, got {}", in_quotes(axis)));
}

/// Half of the height of the picture over its distance.
double half_height_of(const ViewAngle& angle, double aspect) {
    const double half = std::tan(0.5 * glm::radians(angle.degrees));
    return angle.axis == 'y' ? half : half / (angle.axis == 'x' ? aspect : std::hypot(aspect, 1.0));
}

/// Looks along +z of its place, with +x to the left. [Mitsuba 3, perspective]
CameraDescription camera_of(const MitsubaObject& sensor, float aspect, const glm::dvec3& origin) {
    glm::dmat4 to_world = sensor.transform("to_world");
    to_world[3] -= glm::dvec4(origin, 0.0);
    const glm::dvec3 forward = glm::normalize(glm::dvec3(to_world[2]));
    const ViewAngle angle = angle_of(sensor, static_cast<double>(aspect));
    if (!(angle.degrees > 0.0 && angle.degrees < 180.0) || !std::isfinite(forward.x))
        sensor.fail(fmt::format("expected a direction, and 'fov' within (0, 180) degrees, got {}", angle.degrees));
    const double half = half_height_of(angle, static_cast<double>(aspect));
    const double distance = static_cast<double>(sensor.number("focus_distance").value_or(1.0f));
    CameraDescription camera;
    camera.eye = glm::vec3(to_world[3]);
    camera.target = glm::vec3(glm::dvec3(to_world[3]) + target_distance(camera.eye) * forward);
    camera.up = glm::vec3(to_world[1]);
    camera.fov_deg = static_cast<float>(glm::degrees(2.0 * std::atan(half)));
    camera.aperture_radius = sensor.type() == "thinlens" ? sensor.number("aperture_radius").value_or(0.0f) : 0.0f;
    camera.focus_distance = static_cast<float>(distance);
    camera.is_mirrored = glm::determinant(glm::dmat3(to_world)) < 0.0;
    return camera;
}

/// The part of space that a camera sees between two distances along its viewing direction: the positive sides of planes.
class SeenSpace {
public:
    SeenSpace(const Camera& camera, double first, double last) {
        const glm::dvec3 axis(camera.axis), center(camera.center), right(camera.right), up(camera.up);
        const auto add = [&](const glm::dvec3& normal, double distance) {
            planes_.emplace_back(normal, -glm::dot(normal, glm::dvec3(camera.eye)) - distance);
        };
        const auto add_side = [&](const glm::dvec3& edge, const glm::dvec3& along) {
            const glm::dvec3 normal = glm::cross(edge, along);
            add(glm::dot(normal, center) < 0.0 ? -normal : normal, 0.0);
        };
        add(axis, first);
        add(-axis, -last);
        add_side(center + right, up);
        add_side(center - right, up);
        add_side(center + up, right);
        add_side(center - up, right);
    }

    bool has_part_of(const SceneDescription& scene) const {
        const auto corners = [&](std::uint32_t triangle, const glm::dmat4x3& to_world) {
            std::array<glm::dvec3, 3> moved;
            for (int k = 0; k < 3; ++k)
                moved[static_cast<std::size_t>(k)] =
                    to_world * glm::dvec4(glm::dvec3(scene.positions[scene.triangles[triangle].vertex[k]]), 1.0);
            return moved;
        };
        for (std::uint32_t i = 0; i < direct_triangles(scene); ++i)
            if (has_part_of(corners(i, glm::dmat4x3(1.0)))) return true;
        const std::vector<Bounds> boxes = mesh_boxes(scene);
        for (const InstanceDescription& instance : scene.instances) {
            if (misses(box_corners(boxes[instance.mesh], instance.to_world))) continue;
            const MeshDescription& mesh = scene.meshes[instance.mesh];
            for (std::uint32_t i = 0; i < mesh.triangle_count; ++i)
                if (has_part_of(corners(mesh.first_triangle + i, glm::dmat4x3(instance.to_world)))) return true;
        }
        return false;
    }

private:
    static double side(const glm::dvec4& plane, const glm::dvec3& point) {
        return glm::dot(plane, glm::dvec4(point, 1.0));
    }

    /// Whether all points are behind one plane: none of their convex hull is in the space then.
    bool misses(std::span<const glm::dvec3> points) const {
        return std::ranges::any_of(planes_, [&](const glm::dvec4& plane) {
            return std::ranges::none_of(points, [&](const glm::dvec3& point) { return side(plane, point) > 0.0; });
        });
    }

    /// Cuts the triangle by one plane after the other. [Sutherland and Hodgman 1974]
    bool has_part_of(const std::array<glm::dvec3, 3>& corners) const {
        if (misses(corners)) return false;
        std::vector<glm::dvec3> polygon(corners.begin(), corners.end());
        for (const glm::dvec4& plane : planes_) {
            std::vector<glm::dvec3> rest;
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const glm::dvec3& to = polygon[(i + 1) % polygon.size()];
                const double a = side(plane, polygon[i]), b = side(plane, to);
                if (a > 0.0) rest.push_back(polygon[i]);
                if ((a > 0.0) != (b > 0.0)) rest.push_back(glm::mix(polygon[i], to, a / (a - b)));
            }
            polygon = std::move(rest);
        }
        return !polygon.empty();
    }

    std::vector<glm::dvec4> planes_;
};

}  // namespace

MitsubaView mitsuba_view(const MitsubaObject& sensor, const glm::dvec3& origin) {
    const MitsubaObject film = sensor.part("film");
    const float width = film.number("width").value_or(768.0f);
    const float height = film.number("height").value_or(576.0f);
    if (!(width >= 1.0f && height >= 1.0f && width <= 65536.0f && height <= 65536.0f))
        film.fail(fmt::format("expected a picture of 1 to 65536 pixels on each side, got {}x{}", width, height));
    const CropWindow crop = crop_of(film, width, height);
    // The offset of the principal point is in sides of the film, right and down, as if the window were there.
    const auto offset = [&](const char* name) { return sensor.number(name).value_or(0.0f); };
    CropWindow seen = crop;
    seen.x += offset("principal_point_offset_x") * width;
    seen.y += offset("principal_point_offset_y") * height;
    return {cropped(camera_of(sensor, width / height, origin), width, height, seen), crop.width, crop.height};
}

void note_clipped(const MitsubaObject& sensor, const SceneDescription& scene) {
    const double near = static_cast<double>(sensor.number("near_clip").value_or(1e-2f));
    const double far = static_cast<double>(sensor.number("far_clip").value_or(1e4f));
    const MitsubaView view = mitsuba_view(sensor, scene.origin);
    const Camera camera = make_camera(view.camera, static_cast<int>(view.width), static_cast<int>(view.height));
    if (SeenSpace(camera, 0.0, near).has_part_of(scene))
        sensor.note(fmt::format("what is nearer than near_clip, {:g}, is shown", near));
    if (SeenSpace(camera, far, std::numeric_limits<double>::infinity()).has_part_of(scene))
        sensor.note(fmt::format("what is farther than far_clip, {:g}, is shown", far));
}

}  // namespace pl
