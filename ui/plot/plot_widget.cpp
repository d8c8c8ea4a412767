#include "ui/plot/plot_widget.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ui/draw/value_text.h"
#include "ui/draw/widgets.h"

namespace pl::ui {
namespace {

constexpr ImU32 kFloor = IM_COL32(110, 114, 122, 70);
constexpr std::uint32_t kBandAlpha = 56;
constexpr float kPlotRightEm = 0.6f;          ///< right of the curves, for half of a number
constexpr std::uint32_t kGray = 0xff5d636eu;  ///< of hidden runs

ImVec2 to_imgui(Vec2f v) { return {v.x, v.y}; }

float pixel(float x) { return std::round(x) + 0.5f; }

void draw_x_axis(ImDrawList& list, const PlotView& view, const Rect& frame) {
    const int most = std::max(static_cast<int>(frame.width / em(2.1f)), 1);
    float free_from = frame.x - em(1.0f);
    for (const AxisTick& tick : view.x_axis().ticks(most)) {
        const float x = pixel(view.to_window({tick.value, view.y_axis().low()}, frame).x);
        list.AddLine({x, frame.y}, {x, frame.y + frame.height},
                     tick.label.empty() ? colors::kMinorGrid : colors::kGrid);
        const float width = ImGui::CalcTextSize(tick.label.c_str()).x;
        const float left = std::min(x - 0.5f * width, frame.x + frame.width + em(kPlotRightEm) - width);
        if (tick.label.empty() || left < free_from) continue;
        list.AddText({left, frame.y + frame.height + em(0.15f)}, colors::kFaint, tick.label.c_str());
        free_from = left + width + em(0.3f);
    }
}

void draw_y_axis(ImDrawList& list, const PlotView& view, const Rect& frame) {
    const int most = std::max(static_cast<int>(frame.height / em(1.3f)), 1);
    for (const AxisTick& tick : view.y_axis().ticks(most)) {
        const float y = pixel(view.to_window({view.x_axis().low(), tick.value}, frame).y);
        list.AddLine({frame.x, y}, {frame.x + frame.width, y},
                     tick.label.empty() ? colors::kMinorGrid : colors::kGrid);
        if (tick.label.empty()) continue;
        const float width = ImGui::CalcTextSize(tick.label.c_str()).x;
        const float lowest = frame.y + frame.height + em(0.1f) - ImGui::GetFontSize();  // above the first number of x
        list.AddText({frame.x - width - em(0.35f), std::min(y - 0.5f * ImGui::GetFontSize(), lowest)}, colors::kFaint,
                     tick.label.c_str());
    }
}

/// The slope of pure noise, in the corner that curves leave free.
void draw_triangle(ImDrawList& list, const PlotView& view, const Rect& frame, double slope) {
    const double x_decades = std::log10(view.x_axis().high() / view.x_axis().low());
    const double y_decades = std::log10(view.y_axis().high() / view.y_axis().low());
    const double run = std::min(0.18 * x_decades, 0.3 * y_decades / -slope);
    const Vec2f corner{frame.x + em(0.8f), frame.y + frame.height - em(1.9f)};
    const PlotValue low = view.to_value(corner, frame);
    const Vec2f top = view.to_window({low.x, low.y * std::pow(10.0, -slope * run)}, frame);
    const Vec2f right = view.to_window({low.x * std::pow(10.0, run), low.y}, frame);
    list.AddTriangle(to_imgui(corner), to_imgui(top), to_imgui(right), colors::kFaint);
    list.AddText({corner.x, corner.y + em(0.2f)}, colors::kFaint, "as noise falls");
}

void draw_polyline(ImDrawList& list, std::span<const Vec2f> points, ImU32 color, bool is_dashed, float width) {
    if (!is_dashed) {
        for (std::size_t i = 0; i + 1 < points.size(); ++i)
            list.AddLine(to_imgui(points[i]), to_imgui(points[i + 1]), color, width);
        return;
    }
    const std::vector<Vec2f> pieces = dashes(points, em(0.5f), em(0.35f));
    for (std::size_t i = 0; i + 1 < pieces.size(); i += 2)
        list.AddLine(to_imgui(pieces[i]), to_imgui(pieces[i + 1]), color, width);
}

/// Two standard errors of a run around its curve, between neighboring points that have a band.
void draw_band(ImDrawList& list, std::span<const LinePoint> points, const PlotView& view, const Rect& frame,
               ImU32 color) {
    const auto at = [&](const LinePoint& point, double y) {
        return to_imgui(view.to_window({point.value.x, y}, frame));
    };
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const LinePoint& a = points[i];
        const LinePoint& b = points[i + 1];
        if (!(a.low > 0.0) || !(b.low > 0.0)) continue;
        list.AddQuadFilled(at(a, a.high), at(b, b.high), at(b, b.low), at(a, a.low), color);
    }
}

void draw_marker(ImDrawList& list, Vec2f at, ImU32 color, const PlotMarker& marker) {
    const float radius = em(0.17f);
    const ImU32 inside = marker.hollow ? colors::kGround : color;
    if (marker.square) {
        const ImVec2 low{at.x - radius, at.y - radius};
        const ImVec2 high{at.x + radius, at.y + radius};
        list.AddRectFilled(low, high, inside);
        if (marker.hollow) list.AddRect(low, high, color, 0.0f, 0, 1.5f);
        return;
    }
    list.AddCircleFilled(to_imgui(at), radius, inside, 12);
    if (marker.hollow) list.AddCircle(to_imgui(at), radius, color, 12, 1.5f);
}

}  // namespace

Rect plot_frame(const Rect& place) {
    const float left = em(3.4f), right = em(kPlotRightEm), top = em(1.4f), bottom = em(2.5f);
    return {place.x + left, place.y + top, std::max(place.width - left - right, 1.0f),
            std::max(place.height - top - bottom, 1.0f)};
}

void draw_axes(ImDrawList& list, const PlotView& view, const Rect& frame, const PlotStyle& style) {
    const ImVec2 low{frame.x, frame.y};
    const ImVec2 high{frame.x + frame.width, frame.y + frame.height};
    list.AddRectFilled(low, high, colors::kGround);
    draw_x_axis(list, view, frame);
    draw_y_axis(list, view, frame);
    list.AddRect(low, high, colors::kGrid);
    list.PushClipRect(low, high, true);
    if (style.floor > 0.0) {
        const float y = view.to_window({view.x_axis().low(), style.floor}, frame).y;
        list.AddRectFilled({frame.x, y}, high, kFloor);
        constexpr const char* kText = "noise of the reference";
        const float left = frame.x + em(5.0f);
        if (left + ImGui::CalcTextSize(kText).x <= high.x) list.AddText({left, y}, colors::kFaint, kText);
    }
    draw_triangle(list, view, frame, style.slope);
    list.PopClipRect();
    list.AddText({frame.x, frame.y - em(1.25f)}, colors::kText, style.y_title.c_str());
    const float width = ImGui::CalcTextSize(style.x_title.c_str()).x;
    list.AddText({high.x - width, high.y + em(1.25f)}, colors::kText, style.x_title.c_str());
}

void draw_lines(ImDrawList& list, std::span<const PlotLine> lines, const PlotView& view, const Rect& frame) {
    list.PushClipRect({frame.x, frame.y}, {frame.x + frame.width, frame.y + frame.height}, true);
    std::vector<Vec2f> points;
    for (const PlotLine& line : lines) {
        if (line.hidden) continue;
        points.clear();
        for (const LinePoint& point : line.points) points.push_back(view.to_window(point.value, frame));
        const ImU32 color = to_imgui_color(line.color);
        // Only of the run in progress: several bands would hide each other.
        if (line.in_progress)
            draw_band(list, line.points, view, frame, to_imgui_color((line.color & 0xffffffu) | kBandAlpha << 24));
        draw_polyline(list, points, color, line.is_dashed, line.in_progress ? 2.5f : 1.5f);
        for (const Vec2f& point : points) draw_marker(list, point, color, line.marker);
    }
    list.PopClipRect();
}

void draw_cursor_line(ImDrawList& list, const Rect& frame, const PlotView& view, const Cursor& cursor) {
    if (cursor.kind == Cursor::Kind::None) return;
    const bool is_cost = cursor.kind == Cursor::Kind::EqualCost;
    const Vec2f at = view.to_window(
        is_cost ? PlotValue{cursor.at, view.y_axis().low()} : PlotValue{view.x_axis().low(), cursor.at}, frame);
    const ImVec2 high{frame.x + frame.width, frame.y + frame.height};
    const float grip = em(0.4f);
    list.PushClipRect({frame.x - grip, frame.y - grip}, {high.x + grip, high.y + grip}, true);
    if (is_cost) {
        list.AddLine({at.x, frame.y}, {at.x, high.y}, colors::kText, 1.5f);
        list.AddTriangleFilled({at.x, high.y - grip}, {at.x + grip, high.y + grip}, {at.x - grip, high.y + grip},
                               colors::kText);
    } else {
        list.AddLine({frame.x, at.y}, {high.x, at.y}, colors::kText, 1.5f);
        list.AddTriangleFilled({frame.x + grip, at.y}, {frame.x - grip, at.y - grip}, {frame.x - grip, at.y + grip},
                               colors::kText);
    }
    list.PopClipRect();
}

void draw_sample(ImDrawList& list, const PlotLine& line, ImVec2 left, float width) {
    const ImU32 color = to_imgui_color(line.hidden ? kGray : line.color);
    const std::array<Vec2f, 2> ends{Vec2f{left.x, left.y}, Vec2f{left.x + width, left.y}};
    draw_polyline(list, ends, color, line.is_dashed, 2.0f);
    draw_marker(list, 0.5f * (ends[0] + ends[1]), color, line.marker);
}

namespace {

constexpr float kHoverPixels = 14.0f;

PlotStyle style_of(const AccuracyModel& model) {
    const ErrorMetricInfo& metric = info_of(model.kind().metric);
    PlotStyle style{.x_title = model.kind().axis == CostAxis::Seconds ? "seconds charged" : "samples per pixel",
                    .y_title = fmt::format("error ({})", metric.label),
                    .slope = metric.slope,
                    .floor = model.floor()};
    if (model.wanted_metric() != model.kind().metric) style.y_title = "error, by its own noise";
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
    begin_tooltip();
    ImGui::TextColored(to_vec4(to_text_color(line.color)), "%s", line.name.c_str());
    ImGui::TextUnformatted(
        fmt::format("{}   {} spp", short_seconds(charged_seconds(measured.clocks)), measured.spp).c_str());
    ImGui::TextUnformatted(fmt::format("{} {:.4g}", info_of(model.kind().metric).label, point.value.y).c_str());
    if (point.low > 0.0)
        ImGui::TextUnformatted(fmt::format("this run: {:.3g} to {:.3g}", point.low, point.high).c_str());
    ImGui::TextUnformatted(std::isfinite(slope) ? fmt::format("slope {:.2f} over the last decade", slope).c_str()
                                                : "slope: too few earlier points");
    if (measured.squared_bias) ImGui::TextUnformatted(bias_text(*measured.squared_bias).c_str());
    if (measured.picture == nullptr) ImGui::TextUnformatted("its picture was dropped");
    end_tooltip();
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
        tooltip("Click to hide or show.");
        ImDrawList& list = *ImGui::GetWindowDrawList();
        draw_sample(list, line, {at.x, at.y + 0.5f * ImGui::GetTextLineHeight()}, sample);
        list.AddText({at.x + sample + em(0.4f), at.y}, line.hidden ? colors::kFaint : colors::kText,
                     line.name.c_str());
    }
    if (clicked != 0) model.toggle_hidden(clicked);
}

}  // namespace pl::ui
