#include "ui/model/display_controls.h"

#include <algorithm>
#include <cmath>

#include "core/kernel/film/tonemap.h"
#include "core/session/shown_range.h"

namespace pl::ui {

void DisplayControls::set_exposure(float ev) {
    settings_.exposure_ev = std::clamp(ev, -kMaxExposureEv, kMaxExposureEv);
    worker_.set_display(settings_);
}

void DisplayControls::set_curve(ToneCurve curve) {
    settings_.curve = curve;
    worker_.set_display(settings_);
}

void DisplayControls::set_cells(bool on) {
    cells_ = on;
    worker_.set_cells_wanted(cells_ || outline_);
}

void DisplayControls::set_cells_opacity(float opacity) { cells_opacity_ = std::clamp(opacity, 0.0f, 1.0f); }

void DisplayControls::set_outline(bool on) {
    outline_ = on;
    worker_.set_cells_wanted(cells_ || outline_);
}

const ValueRange& DisplayControls::heat_range(const PublishedFrame& frame) const {
    if (ranged_frame_ == frame.serial && ranged_by_ == heat_rule_) return heat_range_;
    std::vector<float> values;
    for (const Vec3f& pixel : frame.snapshot.pixels)
        if (std::isfinite(pixel.x)) values.push_back(pixel.x);
    heat_range_ = range_of(values, heat_rule_);
    ranged_by_ = heat_rule_;
    ranged_frame_ = frame.serial;
    return heat_range_;
}

void DisplayControls::set_low_resolution(bool allowed) {
    low_resolution_ = allowed;
    worker_.set_low_resolution_allowed(allowed);
}

void DisplayControls::set_preview(bool allowed) {
    preview_ = allowed;
    worker_.set_preview_allowed(allowed);
}

namespace {

constexpr float kBinsPerStop =
    static_cast<float>(LuminanceHistogram::kBins) / (LuminanceHistogram::kHigh - LuminanceHistogram::kLow);

}  // namespace

LuminanceHistogram make_histogram(std::span<const Vec3f> pixels, std::size_t most) {
    LuminanceHistogram histogram;
    // An odd step, so that it visits every column of pictures with an even width.
    const std::size_t step = pixels.size() > most ? (pixels.size() + most - 1) / most | 1u : 1;
    for (std::size_t i = 0; i < pixels.size(); i += step) {
        const float light = luminance(pixels[i]);
        ++histogram.pixels;
        if (!std::isfinite(light)) {
            ++histogram.invalid;
            continue;
        }
        const float at = light > 0.0f ? (std::log2(light) - LuminanceHistogram::kLow) * kBinsPerStop : -1.0f;
        if (at < 0.0f)
            ++histogram.dark;
        else if (at >= static_cast<float>(LuminanceHistogram::kBins))
            ++histogram.bright;
        else
            ++histogram.counts[static_cast<std::size_t>(at)];
    }
    return histogram;
}

std::optional<float> LuminanceHistogram::percentile(float share) const {
    if (counted() == 0) return std::nullopt;
    const float wanted = std::clamp(share, 0.0f, 1.0f) * static_cast<float>(counted());
    float below = 0.0f;
    float last = kLow;
    for (std::size_t bin = 0; bin < counts.size(); ++bin) {
        const auto inside = static_cast<float>(counts[bin]);
        if (inside == 0.0f) continue;
        if (below + inside >= wanted)
            return kLow + (static_cast<float>(bin) + (wanted - below) / inside) / kBinsPerStop;
        below += inside;
        last = kLow + static_cast<float>(bin + 1) / kBinsPerStop;
    }
    return last;
}

std::optional<float> LuminanceHistogram::mean(float low_share, float high_share) const {
    if (counted() == 0) return std::nullopt;
    const float first = low_share * static_cast<float>(counted());
    const float last = high_share * static_cast<float>(counted());
    float below = 0.0f;
    double sum = 0.0;
    double weight = 0.0;
    for (std::size_t bin = 0; bin < counts.size(); ++bin) {
        const auto inside = static_cast<float>(counts[bin]);
        const float part = std::min(below + inside, last) - std::max(below, first);
        below += inside;
        if (!(part > 0.0f)) continue;
        sum += static_cast<double>(part) * (kLow + (static_cast<double>(bin) + 0.5) / kBinsPerStop);
        weight += static_cast<double>(part);
    }
    return weight > 0.0 ? std::optional(static_cast<float>(sum / weight)) : percentile(0.5f);
}

std::optional<float> automatic_exposure(const LuminanceHistogram& histogram) {
    constexpr float kGray = 0.18f;
    const std::optional<float> mean = histogram.mean(0.05f, 0.95f);
    return mean ? std::optional(std::log2(kGray) - *mean) : std::nullopt;
}

namespace {

constexpr float kNear = 0.5f;  ///< stops, from which the rest is gone at once
constexpr float kGrain = 0.05f;

/// A number that reads well on a command line.
float rounded(float exposure) { return std::round(exposure / kGrain) * kGrain; }

}  // namespace

void AutoExposure::set_on(bool on) {
    is_on_ = on;
    set_to_ = display_.settings().exposure_ev;
    followed_ = 0;
}

const LuminanceHistogram* AutoExposure::histogram() {
    const auto& frame = link_.frame();
    if (!frame || !frame->has_values() || is_heat_map(frame->snapshot.slot.view)) return nullptr;
    if (made_of_ != frame->serial) {
        histogram_ = make_histogram(frame->snapshot.pixels);
        made_of_ = frame->serial;
        ++times_made_;
    }
    return &histogram_;
}

void AutoExposure::update() {
    if (!is_on_) return;
    if (display_.settings().exposure_ev != set_to_) {
        is_on_ = false;
        return;
    }
    const auto& frame = link_.frame();
    if (!frame || frame->serial == followed_ || !frame->has_values() || !shows_radiance(frame->snapshot.slot.view))
        return;
    followed_ = frame->serial;
    const std::optional<float> wanted = automatic_exposure(*histogram());
    if (!wanted || std::fabs(*wanted - set_to_) < kRest) return;
    const float way = *wanted - set_to_;
    display_.set_exposure(rounded(std::fabs(way) < kNear ? *wanted : set_to_ + 0.5f * way));
    set_to_ = display_.settings().exposure_ev;  // limited
}

}  // namespace pl::ui
