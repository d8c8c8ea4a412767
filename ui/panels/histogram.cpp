#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/session/shown_range.h"
#include "ui/draw/value_text.h"
#include "ui/draw/widgets.h"
#include "ui/panels/panels.h"

namespace pl::ui {
namespace {

using Histogram = LuminanceHistogram;

/// The range of the axis: binary logarithms of luminance.
constexpr float kFirst = -10.0f;
constexpr float kLast = 8.0f;

/// The rectangle of the curve, with the place of a luminance in it.
struct HistogramPlot {
    ImVec2 low;
    ImVec2 high;

    float x_of(float log2_luminance) const {
        return low.x + (high.x - low.x) * (log2_luminance - kFirst) / (kLast - kFirst);
    }
};

/// Heights by the square root, so that a small share of bright pixels is seen.
void draw_bars(ImDrawList& list, const HistogramPlot& plot, const Histogram& histogram) {
    const auto largest = static_cast<float>(*std::ranges::max_element(histogram.counts));
    const float stops = (Histogram::kHigh - Histogram::kLow) / static_cast<float>(Histogram::kBins);
    for (int bin = 0; bin < Histogram::kBins; ++bin) {
        const auto count = static_cast<float>(histogram.counts[static_cast<std::size_t>(bin)]);
        const float from = Histogram::kLow + stops * static_cast<float>(bin);
        if (count == 0.0f || from < kFirst || from + stops > kLast) continue;
        const float height = (plot.high.y - plot.low.y) * std::sqrt(count / largest);
        list.AddRectFilled({plot.x_of(from), plot.high.y - std::max(height, 1.0f)},
                           {plot.x_of(from + stops), plot.high.y}, colors::kFaint);
    }
}

void draw_mark(ImDrawList& list, const HistogramPlot& plot, float log2_luminance, ImU32 color, const char* name) {
    const float x = plot.x_of(std::clamp(log2_luminance, kFirst, kLast));
    list.AddLine({x, plot.low.y}, {x, plot.high.y}, color, 2.0f);
    const float width = ImGui::CalcTextSize(name).x;
    const float text_x = std::clamp(x + em(0.2f), plot.low.x, plot.high.x - width);
    list.AddText({text_x, plot.low.y}, color, name);
}

/// Share of the pixels whose luminance is beyond white, or rounds to the code 0.
std::string clipped_text(const Histogram& histogram, float exposure_ev) {
    constexpr float kFirstCode = -11.66f;  // 0.5/255 of sRGB, 1/12.92 of it linear, as a binary logarithm
    const float stops = (Histogram::kHigh - Histogram::kLow) / static_cast<float>(Histogram::kBins);
    std::uint32_t bright = histogram.bright;
    std::uint32_t dark = histogram.dark;
    for (int bin = 0; bin < Histogram::kBins; ++bin) {
        const float middle = Histogram::kLow + stops * (static_cast<float>(bin) + 0.5f) + exposure_ev;
        const std::uint32_t count = histogram.counts[static_cast<std::size_t>(bin)];
        if (middle > 0.0f) bright += count;
        if (middle < kFirstCode) dark += count;
    }
    const auto percent = [&](std::uint32_t count) {
        return 100.0 * static_cast<double>(count) / std::max(1.0, static_cast<double>(histogram.pixels));
    };
    return fmt::format("{:.1f} % above white, {:.1f} % black", percent(bright), percent(dark));
}

void draw_numbers(const Histogram& histogram, float exposure_ev) {
    text_row("Clipped", clipped_text(histogram, exposure_ev), "At this exposure, without the tone curve.");
    const auto low = histogram.percentile(0.05f);
    const auto middle = histogram.percentile(0.5f);
    const auto high = histogram.percentile(0.95f);
    if (low && middle && high)
        text_row("Luminance",
                 fmt::format("{}  {}  {}", short_value(std::exp2(*low)), short_value(std::exp2(*middle)),
                             short_value(std::exp2(*high))),
                 "Below it are 5, 50 and 95 percent of the pixels that are not black.");
    if (histogram.invalid > 0)
        text_row("Invalid", fmt::format("{} of {}", histogram.invalid, histogram.pixels), "NaN or infinite.",
                 colors::kError);
}

}  // namespace

void draw_histogram(ViewerModel& model) {
    if (!section("Histogram", true)) return;
    model.window().values_shown = true;
    const Histogram* histogram = model.exposure().histogram();
    if (histogram == nullptr) return faint_text("This view has no radiance, or its values are on their way.");
    const float exposure = display_of(model.frame()->snapshot.slot.view, model.display().settings()).exposure_ev;
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 size{ImGui::GetContentRegionAvail().x, em(5.5f)};
    ImGui::Dummy(size);
    note_place("histogram");
    tooltip("Pixels by the logarithm of their luminance, from 2^-10 to 2^8; heights are square roots. White: the "
            "luminance that the "
            "exposure shows as white. Gray: that of 18 percent of it.");
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const HistogramPlot plot{low, {low.x + size.x, low.y + size.y}};
    list.AddRectFilled(plot.low, plot.high, colors::kBadge);
    if (histogram->counted() > 0) draw_bars(list, plot, *histogram);
    draw_mark(list, plot, std::log2(0.18f) - exposure, colors::kAccent, "gray");
    draw_mark(list, plot, -exposure, colors::kText, "white");
    draw_numbers(*histogram, exposure);
}

void draw_auto_exposure(ViewerModel& model) {
    bool is_on = model.exposure().is_on();
    if (toggle_row("Automatic exposure",
                   "O: follows the picture, so that the mean logarithm of its luminance becomes a middle gray. It "
                   "settles within "
                   "a few frames; display only. Another exposure switches it off.",
                   &is_on))
        model.exposure().set_on(is_on);
}

}  // namespace pl::ui
