#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/kernel/guiding/direction_cells.h"
#include "ui/draw/method_keys.h"
#include "ui/draw/widgets.h"
#include "ui/panels/panels.h"

namespace pl {
namespace {

constexpr float kLegendEm = 5.8f;

/// The unit disk in the window: x to the right, y up.
struct DiskPlace {
    ImVec2 center;
    float radius;

    ImVec2 operator()(Vec2f disk) const { return {center.x + radius * disk.x, center.y - radius * disk.y}; }
    Vec2f inverse(ImVec2 window) const { return {(window.x - center.x) / radius, (center.y - window.y) / radius}; }
};

void draw_choices(CellDisplay& display) {
    int quantity = static_cast<int>(display.quantity);
    ImGui::SetNextItemWidth(em(8.5f));
    if (ImGui::Combo("##quantity", &quantity, "radiance Q\0probability P\0visits\0"))
        display.quantity = static_cast<CellQuantity>(quantity);
    tooltip("Q: learned incident radiance of a cell. P: probability to sample it. Visits: its training samples.");
    ImGui::SameLine();
    bool logarithmic = display.scale == ColorScale::Logarithmic;
    if (ImGui::Checkbox("logarithmic", &logarithmic))
        display.scale = logarithmic ? ColorScale::Logarithmic : ColorScale::Linear;
    tooltip("Logarithmic colors over three decades below the largest value.");
}

void draw_legend(ImDrawList& list, const DiskPlace& place, const CellValues& values, ColorScale scale) {
    constexpr int kSteps = 48;
    const float x = std::round(place.center.x + place.radius + em(1.0f));
    const float top = place.center.y - place.radius;
    const float height = 2.0f * place.radius;
    const float width = em(0.9f);
    for (int i = 0; i < kSteps; ++i) {
        const float t = (static_cast<float>(i) + 0.5f) / kSteps;
        const float y1 = std::round(top + height * (1.0f - static_cast<float>(i) / kSteps));
        const float y0 = std::round(top + height * (1.0f - static_cast<float>(i + 1) / kSteps));
        list.AddRectFilled({x, y0}, {x + width, y1}, map_color(t));
    }
    for (int tick = 0; tick <= 4; ++tick) {
        const float t = static_cast<float>(tick) / 4.0f;
        const float y = top + height * (1.0f - t);
        list.AddLine({x + width, y}, {x + width + em(0.25f), y}, colors::kFaint);
        const std::string text = short_value(value_at(values, scale, t));
        const float text_y = std::clamp(y - 0.5f * ImGui::GetFontSize(), top, top + height - ImGui::GetFontSize());
        list.AddText({x + width + em(0.4f), text_y}, colors::kText, text.c_str());
    }
}

void draw_cell_tooltip(const VolumeInspection& volume, int cell, Vec2f disk) {
    const auto index = static_cast<std::size_t>(cell);
    const float cells = static_cast<float>(volume.probability.size());
    const Vec3f direction = lift_to_hemisphere(disk);
    constexpr float kToDeg = 180.0f / kPi;
    ImGui::BeginTooltip();
    ImGui::Text("cell %d (column %d, row %d)", cell, cell % volume.side, cell / volume.side);
    ImGui::Text("%.0f\xc2\xb0 from the normal, %.0f\xc2\xb0 around it", std::acos(direction.z) * kToDeg,
                std::atan2(direction.y, direction.x) * kToDeg);
    ImGui::Separator();
    text_row("radiance Q", fmt::format("{:.4g}", volume.radiance[index]));
    text_row("probability P", fmt::format("{:.4g}", volume.probability[index]));
    text_row("P / uniform", fmt::format("{:.3f}", volume.probability[index] * cells));
    text_row("visits", fmt::format("{}", volume.visits[index]));
    ImGui::EndTooltip();
}

/// Marks the direction towards the camera with a ring, and the frame's x axis with a tick.
void draw_marks(ImDrawList& list, const DiskPlace& place, const VolumeInspection& volume, Vec3f eye) {
    list.AddCircle(place.center, place.radius, colors::kFaint, 96, 1.0f);
    list.AddLine(place({1.0f, 0.0f}), place({1.05f, 0.0f}), colors::kText, 2.0f);
    list.AddText({place({1.05f, 0.0f}).x - em(0.1f), place.center.y - em(1.3f)}, colors::kFaint, "x");
    const std::optional<Vec2f> camera = disk_point_of(volume, glm::normalize(eye - volume.position));
    if (!camera) return;
    list.AddCircle(place(*camera), em(0.45f), IM_COL32(0, 0, 0, 255), 24, 3.0f);
    list.AddCircle(place(*camera), em(0.45f), IM_COL32(255, 255, 255, 255), 24, 1.5f);
}

void draw_disk(ViewerModel& model, const VolumeInspection& volume) {
    const CellDisplay& display = model.window().cell_display;
    const float available = ImGui::GetContentRegionAvail().x;
    const float side = std::min(available - em(kLegendEm), em(19.0f));
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const DiskPlace place{{corner.x + 0.5f * side + em(0.2f), corner.y + 0.5f * side + em(0.4f)}, 0.5f * side};
    ImGui::InvisibleButton("disk", {available, side + em(0.8f)});

    const CellValues values = cell_values(volume, display.quantity, display.scale);
    const std::vector<CellFan> fans = make_cell_fans(volume.side);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    std::vector<ImVec2> points(std::tuple_size_v<CellFan>);
    const auto place_fan = [&](const CellFan& fan) { std::transform(fan.begin(), fan.end(), points.begin(), place); };
    for (std::size_t cell = 0; cell < fans.size(); ++cell) {
        place_fan(fans[cell]);
        fill_fan(list, points, map_color(values.positions[cell]));
    }
    if (model.frame() != nullptr) draw_marks(list, place, volume, model.frame()->snapshot.camera.eye);
    draw_legend(list, place, values, display.scale);

    model.selection().hover_cell(-1);
    const Vec2f disk = place.inverse(ImGui::GetMousePos());
    if (!ImGui::IsItemHovered() || glm::dot(disk, disk) >= 1.0f) return;
    const int cell = DirectionCells{volume.side}.cell_of(disk_to_square(disk));
    model.selection().hover_cell(cell);
    place_fan(fans[static_cast<std::size_t>(cell)]);
    list.AddPolyline(points.data() + 1, kCellBorderPoints, IM_COL32(255, 255, 255, 255), ImDrawFlags_Closed, 2.0f);
    draw_cell_tooltip(volume, cell, disk);
}

void draw_summary(const VolumeInspection& volume) {
    const TableSummary summary = summarize(volume);
    const auto cells = static_cast<double>(volume.probability.size());
    text_row("Position",
             fmt::format("{:.4g}  {:.4g}  {:.4g}", volume.position.x, volume.position.y, volume.position.z));
    text_row("Normal", fmt::format("{:.3f}  {:.3f}  {:.3f}", volume.normal.x, volume.normal.y, volume.normal.z));
    text_row("Visits", short_number(static_cast<double>(summary.visits)), "Training samples of all cells.");
    text_row("Unseen", fmt::format("{} of {:.0f} cells", summary.empty_cells, cells),
             "Cells without training samples.");
    text_row("Entropy", fmt::format("{:.2f} of {:.2f} bits", summary.entropy_bits, std::log2(cells)),
             "Of the sampling probabilities. The maximum is a uniform table: cosine sampling.");
    text_row("Effective", fmt::format("{:.1f} cells, peak {:.1f} x mean", summary.effective_cells, summary.peak),
             "2 to the power of the entropy; largest over mean probability.");
    text_row("Irradiance", fmt::format("{:.4g}", volume.mean_radiance * kPi), "Learned irradiance, as luminance.");
}

}  // namespace

void draw_volume_tab(ViewerModel& model) {
    if (model.selection().volume() == kNoVolume) {
        model.selection().hover_cell(-1);
        faint_text("Click a surface in the picture to see its learned incident radiance.");
        return;
    }
    ImGui::Text("Radiance volume %d", model.selection().volume());
    ImGui::SameLine();
    if (ImGui::SmallButton("deselect")) {
        model.selection().deselect();
        return;
    }
    const VolumeInspection* volume = model.selection().inspection();
    if (volume == nullptr) {
        model.selection().hover_cell(-1);
        faint_text(info_of(model.render().method()).uses_field
                       ? "The field of this volume is shown after the present pass."
                       : fmt::format("This method has no field. Press {} to precompute one, or {} to learn one while "
                                     "rendering.",
                                     method_keys(&MethodInfo::precomputes), method_keys(&MethodInfo::learns))
                             .c_str());
        return;
    }
    draw_choices(model.window().cell_display);
    draw_disk(model, *volume);
    ImGui::Separator();
    draw_summary(*volume);
}

}  // namespace pl
