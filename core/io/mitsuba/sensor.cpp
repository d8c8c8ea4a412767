#include "core/io/mitsuba/sensor.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

namespace pl {
namespace {

/// The part of a film that is rendered, in pixels.
struct Crop {
    float film_width, film_height;
    float x, y;  ///< of its top left corner
    float width, height;
};

Crop crop_of(const MitsubaObject& film, float width, float height) {
    const float x = film.number("crop_offset_x").value_or(0.0f);
    const float y = film.number("crop_offset_y").value_or(0.0f);
    const Crop crop{width,
                    height,
                    x,
                    y,
                    film.number("crop_width").value_or(width - x),
                    film.number("crop_height").value_or(height - y)};
    if (!(x >= 0.0f && y >= 0.0f && crop.width >= 1.0f && crop.height >= 1.0f && x + crop.width <= width &&
          y + crop.height <= height))
        film.fail(fmt::format("expected a crop within {:.0f}x{:.0f} pixels, got {}x{} at ({}, {})", width, height,
                              crop.width, crop.height, x, y));
    return crop;
}

/// The camera of a crop: of a smaller angle, and shifted. The offset of the principal point is in sides of the film, right and down.
CameraDescription cropped(CameraDescription camera, const MitsubaObject& sensor, const Crop& crop) {
    const auto offset = [&](const char* name) { return sensor.number(name).value_or(0.0f); };
    const float middle_x = crop.x + 0.5f * crop.width + offset("principal_point_offset_x") * crop.film_width;
    const float middle_y = crop.y + 0.5f * crop.height + offset("principal_point_offset_y") * crop.film_height;
    camera.shift = {(middle_x - 0.5f * crop.film_width) / crop.height,
                    (0.5f * crop.film_height - middle_y) / crop.height};
    if (crop.height != crop.film_height) {
        const double tangent = std::tan(0.5 * glm::radians(static_cast<double>(camera.fov_deg)));
        camera.fov_deg = static_cast<float>(
            glm::degrees(2.0 * std::atan(tangent * static_cast<double>(crop.height / crop.film_height))));
    }
    return camera;
}

/// 1, or far from the origin more: floats there would turn the view to a target at 1.
double target_distance(const glm::vec3& eye) {
    constexpr double kFar = 1024.0;
    const glm::dvec3 away = glm::abs(glm::dvec3(eye));
    return std::exp2(std::ceil(std::log2(std::max({kFar, away.x, away.y, away.z}) / kFar)));
}

/// Looks along +z of its place. [Mitsuba 3, perspective]
CameraDescription camera_of(const MitsubaObject& sensor, float aspect) {
    const glm::dmat4 to_world = sensor.transform("to_world");
    const glm::dvec3 forward = glm::normalize(glm::dvec3(to_world[2]));
    const double fov = static_cast<double>(sensor.number("fov").value_or(39.5978f));
    if (!(fov > 0.0 && fov < 180.0) || !std::isfinite(forward.x))
        sensor.fail(fmt::format("expected a direction, and 'fov' within (0, 180) degrees, got {}", fov));
    const std::string axis = mitsuba_name(sensor.text("fov_axis").value_or("x"));
    const bool is_vertical =
        axis == "y" || (axis == "smaller" && aspect > 1.0f) || (axis == "larger" && aspect < 1.0f);
    const double half = std::tan(0.5 * glm::radians(fov)) / (is_vertical ? 1.0 : static_cast<double>(aspect));
    const double distance = static_cast<double>(sensor.number("focus_distance").value_or(1.0f));
    CameraDescription camera;
    camera.eye = glm::vec3(to_world[3]);
    camera.target = glm::vec3(glm::dvec3(to_world[3]) + target_distance(camera.eye) * forward);
    camera.up = glm::vec3(to_world[1]);
    camera.fov_deg = static_cast<float>(glm::degrees(2.0 * std::atan(half)));
    camera.aperture_radius = sensor.type() == "thinlens" ? sensor.number("aperture_radius").value_or(0.0f) : 0.0f;
    camera.focus_distance = static_cast<float>(distance);
    return camera;
}

}  // namespace

MitsubaView mitsuba_view(const MitsubaObject& sensor) {
    const MitsubaObject film = sensor.child("film");
    const float width = film.number("width").value_or(768.0f);
    const float height = film.number("height").value_or(576.0f);
    if (!(width >= 1.0f && height >= 1.0f && width <= 65536.0f && height <= 65536.0f))
        film.fail(fmt::format("expected a picture of 1 to 65536 pixels on each side, got {}x{}", width, height));
    const Crop crop = crop_of(film, width, height);
    return {cropped(camera_of(sensor, width / height), sensor, crop), crop.width, crop.height};
}

}  // namespace pl
