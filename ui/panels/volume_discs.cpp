#include "ui/panels/volume_discs.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ui/panels/disc_widget.h"

namespace pl {
namespace {

constexpr float kLargestDiscEm = 19.0f;
constexpr float kSmallestDiscEm = 2.0f;  ///< in a window with no room for it, too
constexpr float kGapEm = 0.8f;

struct Disc {
    const char* caption;
    std::vector<float> values;
};

std::vector<float> normalized(std::vector<float> values) {
    float total = 0.0f;
    for (const float value : values) total += value;
    if (total > 0.0f)
        for (float& value : values) value /= total;
    return values;
}

/// The learned disc and, if it is known, the true one.
std::vector<Disc> discs_of(const VolumeInspection& volume, CellQuantity quantity, const LightReport* report) {
    if (report == nullptr || report->mixture_shares.size() != volume.radiance.size())
        return {{"learned", cell_values(volume, quantity)}};
    switch (quantity) {
    case CellQuantity::Radiance: return {{"learned", volume.radiance}, {"true", report->light.target}};
    case CellQuantity::Probability:
        return {{"table", volume.probability}, {"true", normalized(report->light.target)}};
    case CellQuantity::Density:
        return {{"guided paths", relative_to_cosine(report->mixture_shares)},
                {"light x BSDF", relative_to_cosine(report->product_shares)}};
    case CellQuantity::Visits: break;
    }
    return {{"learned", cell_values(volume, quantity)}};
}

ValueRange common_range(const std::vector<Disc>& discs, const RangeRule& rule) {
    std::vector<float> all;
    for (const Disc& disc : discs) all.insert(all.end(), disc.values.begin(), disc.values.end());
    return range_of(all, rule);
}

void draw_cell_tooltip(const VolumeInspection& volume, const std::vector<Disc>& discs, int cell, Vec3f direction) {
    const auto index = static_cast<std::size_t>(cell);
    constexpr float kToDeg = 180.0f / kPi;
    const float cosine = std::clamp(glm::dot(direction, volume.normal), -1.0f, 1.0f);
    ImGui::BeginTooltip();
    ImGui::Text("cell %d (column %d, row %d)", cell, cell % volume.side, cell / volume.side);
    ImGui::Text("%.0f\xc2\xb0 from the normal", static_cast<double>(std::acos(cosine) * kToDeg));
    if (discs.size() > 1)
        for (const Disc& disc : discs) text_row(disc.caption, fmt::format("{:.4g}", disc.values[index]));
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

}  // namespace

void draw_volume_discs(ViewerModel& model, const VolumeInspection& volume) {
    const CellDisplay& display = model.window().cell_display;
    const DiscShape shape(volume, model.frame()->snapshot.camera);
    const LightReport* report = display.truth ? model.selection().light().report() : nullptr;
    const std::vector<Disc> discs = discs_of(volume, display.quantity, report);
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
    const ValueRange range = common_range(discs, display.range);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (std::size_t i = 0; i < discs.size(); ++i) {
        const DiscPlace& place = places[i];
        list.AddText({place.center.x - place.radius, place.center.y - place.radius - em(1.7f)}, colors::kText,
                     discs[i].caption);
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
    if (cell >= 0) draw_cell_tooltip(volume, discs, cell, direction);
}

}  // namespace pl
