#include "ui/plot/plot_widget.h"

#include <cmath>

#include <fmt/format.h>

#include "ui/draw/value_text.h"
#include "ui/draw/widgets.h"
#include "ui/plot/draw_plot.h"

namespace pl::ui {
namespace {

constexpr float kHoverPixels = 14.0f;

PlotStyle style_of(const AccuracyModel& model) {
    const ErrorMetricInfo& metric = info_of(model.kind().metric);
    PlotStyle style{.x_title = model.kind().axis == CostAxis::Seconds ? "seconds charged" : "samples per pixel",
                    .y_title = metric.label,
                    .slope = metric.slope,
                    .floor = model.floor()};
    if (model.wanted_metric() != model.kind().metric) style.y_title = "own noise, without a reference";
    return style;
}

std::optional<float> line_of(const AccuracyModel& model, Cursor::Kind kind, const Rect& frame) {
    const Cursor& cursor = model.cursor();
    if (cursor.kind != kind) return std::nullopt;
    const PlotView& view = model.view();
    if (kind == Cursor::Kind::EqualCost) return view.to_window({cursor.at, view.y_axis().low()}, frame).x;
    return view.to_window({view.x_axis().low(), cursor.at}, frame).y;
}

/// The cursor at the pointer, clamped to the frame.
Cursor cursor_at(const AccuracyModel& model, PlotDrag drag, Vec2f pointer, const Rect& frame) {
    const Vec2f inside{clamp_to(pointer.x, frame.x, frame.x + frame.width),
                       clamp_to(pointer.y, frame.y, frame.y + frame.height)};
    const PlotValue value = model.view().to_value(inside, frame);
    if (drag == PlotDrag::EqualCost) return {Cursor::Kind::EqualCost, value.x};
    return {Cursor::Kind::EqualError, value.y};
}

void show_cursor_shape(PlotDrag drag) {
    if (drag == PlotDrag::EqualCost) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (drag == PlotDrag::EqualError) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeNS);
}

/// True if a cursor was moved.
bool handle_pointer(AccuracyModel& model, PlotDrag& drag, const Rect& frame) {
    const ImGuiIO& io = ImGui::GetIO();
    const Vec2f pointer{io.MousePos.x, io.MousePos.y};
    const PlotDrag under = drag_at(pointer, frame, line_of(model, Cursor::Kind::EqualCost, frame),
                                   line_of(model, Cursor::Kind::EqualError, frame));
    if (!ImGui::IsItemActive()) drag = PlotDrag::None;
    if (ImGui::IsItemHovered()) {
        show_cursor_shape(drag == PlotDrag::None ? under : drag);
        if (ImGui::IsItemClicked(ImGuiMouseButton_Left)) drag = under;
        if (ImGui::IsMouseClicked(ImGuiMouseButton_Right)) model.set_cursor({});
        if (frame.contains(pointer) && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) model.fit_view();
        if (io.MouseWheel != 0.0f) model.zoom_view(io.MouseWheel, pointer, frame);
    }
    if (drag == PlotDrag::Pan && (io.MouseDelta.x != 0.0f || io.MouseDelta.y != 0.0f))
        model.pan_view({io.MouseDelta.x, io.MouseDelta.y}, frame);
    if (drag != PlotDrag::EqualCost && drag != PlotDrag::EqualError) return false;
    model.set_cursor(cursor_at(model, drag, pointer, frame));
    return true;
}

/// The part of relMSE that does not shrink with the number of samples.
std::string bias_text(const Estimate& squared_bias) {
    if (squared_bias.is_seen())
        return fmt::format("bias\u00b2 {:.2g} \u00b1 {:.1g} as relMSE", squared_bias.value, squared_bias.error);
    return fmt::format("no bias\u00b2 seen below {:.2g} as relMSE", 2.0 * squared_bias.error);
}

/// A tooltip for the point under the pointer, and a ring around it.
void draw_hover(const AccuracyModel& model, ImDrawList& list, const Rect& frame) {
    const ImVec2 pointer = ImGui::GetIO().MousePos;
    const auto hit = nearest_point(model.lines(), model.view(), frame, Vec2f{pointer.x, pointer.y}, kHoverPixels);
    if (!hit) return;
    const PlotLine& line = model.lines()[hit->line];
    const LinePoint& point = line.points[hit->point];
    const auto run = find_run(model.runs(), line.run);
    if (!run) return;
    const Vec2f at = model.view().to_window(point.value, frame);
    list.AddCircle({at.x, at.y}, em(0.4f), colors::kText, 16, 1.5f);
    const LivePoint& measured = run->points[point.index];
    Curve until;
    for (const LinePoint& other : line.points)
        if (other.value.x <= point.value.x) until.push_back({other.value.x, other.value.y});
    const double slope = log_slope(until);
    ImGui::BeginTooltip();
    ImGui::TextColored(to_vec4(to_imgui_color(line.color)), "%s", line.name.c_str());
    ImGui::TextUnformatted(
        fmt::format("{}   {} spp", short_seconds(charged_seconds(measured.clocks)), measured.spp).c_str());
    ImGui::TextUnformatted(fmt::format("{} {:.4g}", info_of(model.kind().metric).label, point.value.y).c_str());
    if (point.low > 0.0)
        ImGui::TextUnformatted(fmt::format("this run: {:.3g} to {:.3g}", point.low, point.high).c_str());
    ImGui::TextUnformatted(std::isfinite(slope) ? fmt::format("slope {:.2f} over the last decade", slope).c_str()
                                                : "slope: too few earlier points");
    if (measured.squared_bias) ImGui::TextUnformatted(bias_text(*measured.squared_bias).c_str());
    if (!line.comparable) ImGui::TextUnformatted("another picture: not compared");
    if (measured.picture == nullptr) ImGui::TextUnformatted("its picture was dropped");
    ImGui::EndTooltip();
}

}  // namespace

bool draw_accuracy_plot(AccuracyModel& model, PlotDrag& drag, Rect& frame, float height) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const Rect place{corner.x, corner.y, std::max(ImGui::GetContentRegionAvail().x, em(8.0f)), height};
    frame = plot_frame(place);
    ImGui::InvisibleButton("plot", {place.width, place.height});
    const bool hovered = ImGui::IsItemHovered();
    const bool moved = handle_pointer(model, drag, frame);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    draw_axes(list, model.view(), frame, style_of(model));
    draw_lines(list, model.lines(), model.view(), frame);
    draw_cursor_line(list, frame, model.view(), model.cursor());
    if (hovered && drag == PlotDrag::None) draw_hover(model, list, frame);
    return moved;
}

void draw_legend(AccuracyModel& model, const std::function<bool(const PlotLine&)>& is_shown) {
    const float sample = em(1.8f);
    std::uint64_t clicked = 0;
    float used = 0.0f;
    const float room = ImGui::GetContentRegionAvail().x;
    for (const PlotLine& line : model.lines()) {
        if (!is_shown(line)) continue;
        const float width = sample + em(0.4f) + ImGui::CalcTextSize(line.name.c_str()).x;
        if (used > 0.0f && used + em(0.8f) + width <= room)
            ImGui::SameLine(0.0f, em(0.8f));
        else
            used = 0.0f;
        used += (used > 0.0f ? em(0.8f) : 0.0f) + width;
        const ImVec2 at = ImGui::GetCursorScreenPos();
        ImGui::PushID(static_cast<int>(line.run));
        if (ImGui::InvisibleButton("run", {width, ImGui::GetTextLineHeight()})) clicked = line.run;
        ImGui::PopID();
        tooltip(line.comparable ? "Click to hide or show."
                                : "A run of another picture: not compared. Click to hide or show.");
        ImDrawList& list = *ImGui::GetWindowDrawList();
        draw_sample(list, line, {at.x, at.y + 0.5f * ImGui::GetTextLineHeight()}, sample);
        list.AddText({at.x + sample + em(0.4f), at.y},
                     line.hidden || !line.comparable ? colors::kFaint : colors::kText, line.name.c_str());
    }
    if (clicked != 0) model.toggle_hidden(clicked);
}

}  // namespace pl::ui
