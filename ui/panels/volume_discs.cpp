#include "ui/panels/volume_discs.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ui/model/shown_volumes.h"
#include "ui/panels/disc_widget.h"

namespace pl::ui {
namespace {

constexpr float kLargestDiscEm = 19.0f;
constexpr float kSmallestDiscEm = 2.0f;  ///< in a window with no room for it, too
constexpr float kGapEm = 0.8f;
constexpr float kPinEm = 5.0f;  ///< a pinned volume's disc with its ring

void draw_cell_tooltip(const VolumeInspection& volume, const std::vector<ShownDisc>& discs, int cell,
                       Vec3f direction) {
    const auto index = static_cast<std::size_t>(cell);
    constexpr float kToDeg = 180.0f / kPi;
    const float cosine = std::clamp(glm::dot(direction, volume.normal), -1.0f, 1.0f);
    ImGui::BeginTooltip();
    ImGui::Text("cell %d (column %d, row %d)", cell, cell % volume.side, cell / volume.side);
    ImGui::Text("%.0f\xc2\xb0 from the normal", static_cast<double>(std::acos(cosine) * kToDeg));
    if (discs.size() > 1)
        for (const ShownDisc& disc : discs)
            if (!disc.values.empty()) text_row(disc.caption.c_str(), fmt::format("{:.4g}", disc.values[index]));
    ImGui::Separator();
    text_row("radiance Q", fmt::format("{:.4g}", volume.radiance[index]));
    text_row("probability P", fmt::format("{:.4g}", volume.probability[index]));
    text_row("visits", fmt::format("{}", volume.visits[index]));
    ImGui::EndTooltip();
}

/// The meaning of the marks.
void draw_caption(const DiscShape& shape) {
    faint_text(shape.frame.up_means() == DiscUp::Scene
                   ? "cross: normal; ring: camera; rim: 90\xc2\xb0; arrow: up"
                   : "cross: normal; ring: camera; rim: 90\xc2\xb0; arrow: up in the picture");
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
            model.selection().select_volume(volume.volume);
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
        list.AddText({place.center.x - place.radius, place.center.y - place.radius - em(1.7f)}, colors::kText,
                     discs[i].caption.c_str());
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
    draw_caption(shape);
    draw_pins(model, volumes, range);
    if (cell >= 0) draw_cell_tooltip(volume, discs, cell, direction);
}

}  // namespace pl::ui
