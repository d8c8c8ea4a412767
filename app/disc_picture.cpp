#include "app/disc_picture.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/kernel/film/heat_color.h"
#include "core/kernel/guiding/direction_cells.h"

namespace pl {
namespace {

constexpr int kBarHeight = 12;
constexpr Rgb kShadow{0, 0, 0};

std::string three_digits(float value) { return fmt::format("{:.3g}", value); }

}  // namespace

Rgb map_color_of(float position) {
    const ByteColor color = heat_color(position);
    return {color.r, color.g, color.b};
}

DiscPicture::DiscPicture(int width, int height, const VolumeInspection& volume, const CameraDescription& camera)
    : canvas_(width, height, kBackground), side_(volume.side), frame_(volume.normal, camera),
      to_camera_(glm::normalize(camera.eye - volume.position)) {}

void DiscPicture::draw_disc(const DiscSpot& spot, const std::string& caption, std::span<const float> values,
                            const ValueRange& range) {
    const DirectionCells cells{.side = side_};
    const float radius = 0.5f * static_cast<float>(spot.diameter);
    for (int row = 0; row < spot.diameter; ++row)
        for (int column = 0; column < spot.diameter; ++column) {
            const Vec2f point{(static_cast<float>(column) + 0.5f) / radius - 1.0f,
                              1.0f - (static_cast<float>(row) + 0.5f) / radius};
            if (glm::dot(point, point) > 1.0f) continue;
            const int cell = cells.cell_of(disk_to_square(frame_.to_cells(point)));
            canvas_.put(spot.x + column, spot.y + row,
                        map_color_of(range.position(values[static_cast<std::size_t>(cell)])));
        }
    text(spot.x, spot.y - kLine - 10, caption);
    draw_marks(spot);
}

void DiscPicture::draw_marks(const DiscSpot& spot) {
    const int middle_x = spot.x + spot.diameter / 2;
    const int middle_y = spot.y + spot.diameter / 2;
    for (int i = -5; i <= 5; ++i) {
        canvas_.fill(middle_x + i, middle_y, 1, 2, kInk);
        canvas_.fill(middle_x, middle_y + i, 2, 1, kInk);
    }
    for (int i = 0; i < 6; ++i) canvas_.fill(middle_x - i, spot.y - 8 + i, 2 * i + 1, 1, kInk);
    const std::optional<Vec2f> camera = frame_.point_of(to_camera_);
    if (!camera) return;
    const Vec2f center =
        Vec2f(middle_x, middle_y) + 0.5f * static_cast<float>(spot.diameter) * Vec2f(camera->x, -camera->y);
    for (const auto& [radius, color] : {std::pair{7.0f, kShadow}, std::pair{6.0f, kInk}})
        for (int i = 0; i < 48; ++i) {
            const float angle = 2.0f * kPi * static_cast<float>(i) / 48.0f;
            canvas_.put(static_cast<int>(std::lround(center.x + radius * std::cos(angle))),
                        static_cast<int>(std::lround(center.y + radius * std::sin(angle))), color);
        }
}

void DiscPicture::draw_legend(const DiscSpot& spot, const ValueRange& range) {
    const int y = spot.y + spot.diameter + 10;
    for (int column = 0; column < spot.diameter; ++column)
        canvas_.fill(spot.x + column, y, 1, kBarHeight,
                     map_color_of(static_cast<float>(column) / static_cast<float>(spot.diameter - 1)));
    const int below = y + kBarHeight + 6;
    const std::string low = three_digits(range.low);
    const std::string middle = three_digits(range.value_at(0.5f));
    const std::string high = three_digits(range.high);
    text(spot.x, below, low);
    if (Canvas::text_width(low + " ") + Canvas::text_width(middle) / 2 < spot.diameter / 2 &&
        Canvas::text_width(middle) / 2 + Canvas::text_width(" " + high) < spot.diameter / 2)
        text(spot.x + (spot.diameter - Canvas::text_width(middle)) / 2, below, middle);
    text(spot.x + spot.diameter - Canvas::text_width(high), below, high);
}

}  // namespace pl
