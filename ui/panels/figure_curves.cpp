#include "ui/panels/figure_curves.h"

#include <fmt/format.h>

#include "ui/draw/draw_list.h"
#include "ui/draw/value_text.h"
#include "ui/draw/widgets.h"
#include "ui/model/shown_volumes.h"

namespace pl::ui {
namespace {

constexpr float kCurveEm = 4.2f;
constexpr float kAxisEm = 3.0f;  ///< for the numbers at the left

constexpr ImU32 kTableColor = IM_COL32(86, 180, 233, 255);
constexpr ImU32 kPathsColor = IM_COL32(230, 159, 0, 255);
constexpr ImU32 kVarianceColor = IM_COL32(204, 121, 167, 255);

struct NamedCurve {
    const char* name;
    ImU32 color;
    std::vector<PassPoint> points;
};

PassPoint point_of(std::uint64_t passes, const Interval& interval) {
    return {static_cast<double>(std::max(passes, std::uint64_t{1})), interval.value, interval.low, interval.high};
}

void draw_curve(ImDrawList& list, const NamedCurve& curve, const PassScale& scale, const Rect& rect) {
    ImVec2 last{};
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
        const PassPoint& point = curve.points[i];
        const Vec2f at = scale.place(rect, point.passes, point.value);
        const Vec2f low = scale.place(rect, point.passes, point.low);
        const Vec2f high = scale.place(rect, point.passes, point.high);
        list.AddLine({low.x, low.y}, {high.x, high.y}, (curve.color & 0x00ffffffu) | 0x70000000u, em(0.15f));
        if (i > 0) list.AddLine(last, {at.x, at.y}, curve.color, em(0.1f));
        list.AddCircleFilled({at.x, at.y}, em(0.16f), curve.color);
        last = {at.x, at.y};
    }
}

/// Names in their colors, above the curves.
void draw_names(const std::vector<NamedCurve>& curves) {
    for (const NamedCurve& curve : curves) {
        if (&curve != curves.data()) ImGui::SameLine(0.0f, em(0.8f));
        ImGui::TextColored(to_vec4(curve.color), "%s", curve.name);
    }
}

/// `level`: a value with a line of its own, 0 for none. `shown`: passes of the time that is shown, 0 for now.
void draw_plot(const std::vector<NamedCurve>& curves, double level, std::uint64_t shown) {
    std::vector<PassPoint> all;
    for (const NamedCurve& curve : curves) all.insert(all.end(), curve.points.begin(), curve.points.end());
    const PassScale scale = scale_of(all, level);
    draw_names(curves);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = std::max(ImGui::GetContentRegionAvail().x, em(6.0f));
    ImGui::Dummy({width, em(kCurveEm + 1.3f)});
    const Rect rect{corner.x + em(kAxisEm), corner.y + em(0.3f), width - em(kAxisEm + 0.8f), em(kCurveEm)};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRect({rect.x, rect.y}, {rect.x + rect.width, rect.y + rect.height},
                 (colors::kFaint & 0x00ffffffu) | 0x60000000u);
    const auto number = [&](double value) {
        const Vec2f at = scale.place(rect, scale.first, value);
        const std::string text = short_value(static_cast<float>(value));
        const ImVec2 size = ImGui::CalcTextSize(text.c_str());
        list.AddText({rect.x - size.x - em(0.3f), at.y - 0.5f * size.y}, colors::kFaint, text.c_str());
        return at.y;
    };
    number(0.0);
    number(scale.top / 1.1);
    if (level > 0.0) {
        const float y = scale.place(rect, scale.first, level).y;
        list.AddLine({rect.x, y}, {rect.x + rect.width, y}, colors::kFaint);
    }
    for (const NamedCurve& curve : curves) draw_curve(list, curve, scale, rect);
    if (shown > 0) {
        const float x = scale.place(rect, static_cast<double>(shown), 0.0).x;
        list.AddLine({x, rect.y}, {x, rect.y + rect.height}, colors::kText);
    }
    const std::string left = fmt::format("{:.0f}", scale.first);
    const std::string right = fmt::format("{:.0f} passes", scale.last);
    const float below = rect.y + rect.height + em(0.1f);
    list.AddText({rect.x, below}, colors::kFaint, left.c_str());
    list.AddText({rect.x + rect.width - ImGui::CalcTextSize(right.c_str()).x, below}, colors::kFaint, right.c_str());
}

void draw_scrubber(ViewerModel& model) {
    LearningTime& time = model.time();
    const auto last = static_cast<int>(time.history()->frames.size());
    if (last == 0) return;
    if (ImGui::Button(time.is_playing() ? "stop" : "play", {em(3.2f), 0.0f})) time.set_playing(!time.is_playing());
    note_place("play");
    tooltip("Through all key frames and back. Discs and lobes follow.");
    ImGui::SameLine(0.0f, em(0.4f));
    const bool is_writing = model.past_film().written().has_value();
    if (ImGui::Button(is_writing ? "stop##film" : "film", {em(3.2f), 0.0f})) {
        if (is_writing)
            model.past_film().stop();
        else
            model.past_film().begin();
    }
    note_place("film");
    tooltip(
        "Writes the window at each key frame as a PNG, and with ffmpeg as a film. Tab hides the panels. Esc stops.");
    ImGui::SameLine(0.0f, em(0.4f));
    int at = time.shown() ? static_cast<int>(*time.shown()) : last;
    const FieldHistory& history = *time.history();
    const std::string when = time.frame() != nullptr ? fmt::format("after pass {}", time.frame()->passes()) : "now";
    const std::string label = fmt::format("{} ({} key frame{}, {:.0f} MB)", when, history.frames.size(),
                                          last == 1 ? "" : "s", static_cast<double>(history.bytes) / 1048576.0);
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::SliderInt("##time", &at, 0, last, label.c_str(), ImGuiSliderFlags_NoInput)) {
        time.set_playing(false);
        time.show(at < last ? std::optional(static_cast<std::size_t>(at)) : std::nullopt);
    }
    note_place("time");
    const std::string tip =
        fmt::format("The time that discs and lobes show; the right end is the present. {} key frames "
                    "were given up for others.",
                    history.evicted);
    tooltip(tip.c_str());
}

}  // namespace

void draw_keeping(LearningTime& time) {
    bool keeps = time.keeps();
    if (ImGui::Checkbox("keep the past", &keeps)) time.set_keeps(keeps);
    note_place("keep the past");
    tooltip(
        "Key frames of the whole field, after each of the first 16 passes, then whenever the passes have grown by a "
        "quarter. Ctrl+Shift+R learns anew.");
}

void draw_memory(LearningTime& time) {
    if (!time.keeps()) return;
    ImGui::SetNextItemWidth(-1.0f);
    int megabytes = time.megabytes();
    if (ImGui::SliderInt("##memory", &megabytes, 16, 4096, "key frames: at most %d MB",
                         ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp))
        time.set_megabytes(megabytes);
    tooltip(
        "When they are used up, the frame whose neighbors are nearest to each other, in proportion of their passes, "
        "is given up; never the first or the last.");
}

void draw_figures(const std::vector<FigurePoint>& curve, std::uint64_t shown) {
    std::vector<NamedCurve> divergences{{"field off by", kTableColor, {}}, {"paths off by", kPathsColor, {}}};
    std::vector<NamedCurve> variance{{"variance over that of the BSDF", kVarianceColor, {}}};
    for (const FigurePoint& point : curve) {
        divergences[0].points.push_back(point_of(point.passes, point.figures.table));
        divergences[1].points.push_back(point_of(point.passes, point.figures.mixture));
        if (point.figures.variance_factor)
            variance[0].points.push_back(point_of(point.passes, *point.figures.variance_factor));
    }
    draw_plot(divergences, 0.0, shown);
    if (!variance[0].points.empty()) draw_plot(variance, 1.0, shown);
}

void draw_figure_curves(const ViewerModel& model) {
    const std::vector<FigurePoint>& curve = model.selection().light().curve();
    if (curve.size() < 2) return;
    draw_figures(curve, model.time().frame() != nullptr ? model.time().frame()->passes() : 0);
}

void draw_time(ViewerModel& model, const VolumeInspection& shown) {
    LearningTime& time = model.time();
    draw_scrubber(model);
    const VolumeInspection* now = model.selection().inspection();
    if (time.frame() == nullptr || now == nullptr) return;
    const ShareDifference apart = difference(now->probability, shown.probability);
    text_row("From now",
             fmt::format("KL {:.3g} nats, total variation {:.3g}", apart.divergence, apart.total_variation),
             "The difference of the probabilities of the shown time to those of now: Kullback-Leibler divergence of "
             "now from then, "
             "and the share of probability that moved.");
}

}  // namespace pl::ui
