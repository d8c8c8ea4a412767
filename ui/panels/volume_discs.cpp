#include "ui/panels/volume_discs.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/kernel/guiding/direction_cells.h"
#include "ui/draw/value_text.h"
#include "ui/model/shown_volumes.h"

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

namespace {

constexpr float kLargestDiscEm = 19.0f;
constexpr float kSmallestDiscEm = 2.0f;  ///< in a window with no room for it, too
constexpr float kGapEm = 0.8f;
constexpr float kPinEm = 5.0f;  ///< a pinned volume's disc with its ring

/// The numbers of the cell under the pointer, besides those above the discs; else the meaning of the marks. One line, so that nothing
/// below it moves.
void draw_caption(const VolumeInspection& volume, const DiscShape& shape, int cell, Vec3f direction) {
    const char* const up = shape.frame.up_is_scene() ? "up" : "up in the picture";
    std::string text = fmt::format("cross: normal; ring: camera; rim: 90\u00b0; arrow: {}", up);
    if (cell >= 0) {
        const auto index = static_cast<std::size_t>(cell);
        constexpr float kToDeg = 180.0f / kPi;
        const float cosine = std::clamp(glm::dot(direction, volume.normal), -1.0f, 1.0f);
        text = fmt::format("cell {}, {:.0f}\u00b0 from the normal, P {}, {} visits", cell, std::acos(cosine) * kToDeg,
                           short_value(volume.probability[index]), volume.visits[index]);
    }
    ImGui::TextColored(to_vec4(cell < 0 ? colors::kFaint : colors::kText), "%s", text.c_str());
    note_place("cell numbers");
}

/// The places of discs in a row, below their captions.
std::vector<DiscPlace> places_of(std::size_t count, ImVec2 corner, float width) {
    const auto discs = static_cast<float>(count);
    const float room = (width - em(kLegendEm + 0.2f) - discs * em(kGapEm)) / discs;
    const float diameter = std::clamp(room, em(kSmallestDiscEm), em(kLargestDiscEm));
    std::vector<DiscPlace> places;
    for (std::size_t i = 0; i < count; ++i) {
        const float x = corner.x + em(0.2f) + static_cast<float>(i) * (diameter + em(kGapEm));
        places.push_back({{x + 0.5f * diameter, corner.y + em(1.8f) + 0.5f * diameter}, 0.5f * diameter});
    }
    return places;
}

/// The pinned volumes as small discs on the same scale, each in the color of its pin; a click selects one.
void draw_pins(ViewerModel& model, const std::vector<ShownVolume>& volumes, const ValueRange& range) {
    bool is_first = true;
    for (const ShownVolume& shown : volumes) {
        const VolumeInspection& volume = *shown.volume;
        if (!model.selection().pins().contains(volume.volume)) continue;
        if (!is_first) ImGui::SameLine();
        is_first = false;
        const float side = em(kPinEm);
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        const std::string name = fmt::format("pin {}", volume.volume);
        if (ImGui::InvisibleButton(name.c_str(), {side, side + em(1.2f)}))
            model.selection().select_volume(volume.volume, {volume.position, volume.normal});
        note_place(name.c_str());
        tooltip("A pinned volume, in the color that it has in the picture. A click selects it; K unpins the selected "
                "one.");
        const DiscPlace place{{corner.x + 0.5f * side, corner.y + 0.5f * side}, 0.5f * side - em(0.4f)};
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const DiscShape shape(volume, model.frame()->snapshot.camera);
        const CellQuantity quantity = model.window().cell_display.quantity;
        draw_disc(list, place, shape, positions_in(range, cell_values(volume, quantity)), -1);
        list.AddCircle(place.center, place.radius + em(0.15f), shown.color, 64, em(shown.is_selected ? 0.3f : 0.18f));
        list.AddText({corner.x + em(0.4f), corner.y + side}, shown.color, fmt::format("{}", volume.volume).c_str());
    }
}

}  // namespace

void draw_volume_discs(ViewerModel& model, const VolumeInspection& volume) {
    const DiscShape shape(volume, model.frame()->snapshot.camera);
    const std::vector<ShownDisc> discs = shown_discs(model, volume);
    const float available = std::max(ImGui::GetContentRegionAvail().x, em(kSmallestDiscEm));
    const std::vector<DiscPlace> places = places_of(discs.size(), ImGui::GetCursorScreenPos(), available);
    ImGui::InvisibleButton("discs", {available, 2.0f * places.front().radius + em(2.1f)});

    int cell = -1;
    Vec3f direction{0.0f};
    for (const DiscPlace& place : places) {
        const int under = ImGui::IsItemHovered() ? cell_at(place, shape, volume.side, ImGui::GetMousePos()) : -1;
        if (under < 0) continue;
        cell = under;
        direction = shape.frame.direction_of(place.inverse(ImGui::GetMousePos()));
    }
    model.selection().hover_cell(cell);
    const std::vector<ShownVolume> volumes = shown_volumes(model);
    const ValueRange range = shown_range(model, volumes);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (std::size_t i = 0; i < discs.size(); ++i) {
        const DiscPlace& place = places[i];
        const bool has_value = cell >= 0 && !discs[i].values.empty();
        const std::string caption =
            discs[i].caption +
            (has_value ? " " + short_value(discs[i].values[static_cast<std::size_t>(cell)]) : std::string());
        list.AddText({place.center.x - place.radius, place.center.y - place.radius - em(1.7f)}, colors::kText,
                     caption.c_str());
        draw_disc(list, place, shape, positions_in(range, discs[i].values), cell);
    }
    const DiscPlace& learned = places.front();
    note_place("learned disc", {learned.center.x - learned.radius, learned.center.y - learned.radius,
                                2.0f * learned.radius, 2.0f * learned.radius});
    const DiscPlace& last = places.back();
    draw_legend(
        list,
        {last.center.x + last.radius + em(kGapEm), last.center.y - last.radius, em(kLegendEm), 2.0f * last.radius},
        range);
    draw_caption(volume, shape, cell, direction);
    draw_pins(model, volumes, range);
}

}  // namespace pl::ui
