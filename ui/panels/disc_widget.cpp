#include "ui/panels/disc_widget.h"

#include <algorithm>
#include <cmath>

#include "core/kernel/guiding/direction_cells.h"
#include "ui/draw/value_text.h"

namespace pl::ui {
namespace {

constexpr ImU32 kInk = IM_COL32(255, 255, 255, 255);
constexpr ImU32 kShadow = IM_COL32(0, 0, 0, 255);

/// A thin white line on a dark one, visible on every color of the map.
void add_mark(ImDrawList& list, ImVec2 from, ImVec2 to) {
    list.AddLine(from, to, kShadow, 3.0f);
    list.AddLine(from, to, kInk, 1.5f);
}

void draw_marks(ImDrawList& list, const DiscPlace& place, const DiscShape& shape) {
    list.AddCircle(place.center, place.radius, colors::kFaint, 96, 1.0f);
    const float arm = em(0.3f);
    const ImVec2 middle = place.center;
    add_mark(list, {middle.x - arm, middle.y}, {middle.x + arm, middle.y});
    add_mark(list, {middle.x, middle.y - arm}, {middle.x, middle.y + arm});
    const ImVec2 top = place({0.0f, 1.0f});
    list.AddTriangleFilled({top.x, top.y - em(0.45f)}, {top.x - em(0.3f), top.y}, {top.x + em(0.3f), top.y},
                           colors::kText);
    const std::optional<Vec2f> camera = shape.frame.point_of(shape.to_camera);
    if (!camera) return;
    list.AddCircle(place(*camera), em(0.4f), kShadow, 24, 3.0f);
    list.AddCircle(place(*camera), em(0.4f), kInk, 24, 1.5f);
}

}  // namespace

DiscShape::DiscShape(const VolumeInspection& volume, const CameraDescription& camera)
    : frame(volume.normal, camera), fans(make_cell_fans(volume.side)),
      to_camera(glm::normalize(camera.eye - volume.position)) {
    for (CellFan& fan : fans)
        std::ranges::transform(fan, fan.begin(), [&](Vec2f disk) { return frame.from_cells(disk); });
}

void draw_disc(ImDrawList& list, const DiscPlace& place, const DiscShape& shape, std::span<const float> positions,
               int highlighted) {
    std::vector<ImVec2> points(std::tuple_size_v<CellFan>);
    const auto place_fan = [&](const CellFan& fan) { std::ranges::transform(fan, points.begin(), place); };
    const std::size_t cells = std::min(shape.fans.size(), positions.size());
    for (std::size_t cell = 0; cell < cells; ++cell) {
        place_fan(shape.fans[cell]);
        fill_fan(list, points, map_color(positions[cell]));
    }
    draw_marks(list, place, shape);
    if (highlighted < 0 || static_cast<std::size_t>(highlighted) >= cells) return;
    place_fan(shape.fans[static_cast<std::size_t>(highlighted)]);
    list.AddPolyline(points.data() + 1, kCellBorderPoints, kInk, ImDrawFlags_Closed, 2.0f);
}

int cell_at(const DiscPlace& place, const DiscShape& shape, int side, ImVec2 window) {
    const Vec2f disc = place.inverse(window);
    if (glm::dot(disc, disc) >= 1.0f) return -1;
    return DirectionCells{side}.cell_of(disk_to_square(shape.frame.to_cells(disc)));
}

void draw_legend(ImDrawList& list, const Rect& place, const ValueRange& range) {
    constexpr int kSteps = 48;
    const float x = std::round(place.x);
    const float width = em(0.9f);
    for (int i = 0; i < kSteps; ++i) {
        const float t = (static_cast<float>(i) + 0.5f) / kSteps;
        const float y1 = std::round(place.y + place.height * (1.0f - static_cast<float>(i) / kSteps));
        const float y0 = std::round(place.y + place.height * (1.0f - static_cast<float>(i + 1) / kSteps));
        list.AddRectFilled({x, y0}, {x + width, y1}, map_color(t));
    }
    const int ticks = place.height < em(5.5f) ? 2 : 4;
    for (int tick = 0; tick <= ticks; ++tick) {
        const float t = static_cast<float>(tick) / static_cast<float>(ticks);
        const float y = place.y + place.height * (1.0f - t);
        list.AddLine({x + width, y}, {x + width + em(0.25f), y}, colors::kFaint);
        const std::string text = short_value(range.value_at(t));
        const float text_y =
            std::clamp(y - 0.5f * ImGui::GetFontSize(), place.y, place.y + place.height - ImGui::GetFontSize());
        list.AddText({x + width + em(0.4f), text_y}, colors::kText, text.c_str());
    }
}

}  // namespace pl::ui
