#include "ui/model/auto_exposure.h"

#include <cmath>

#include "core/session/shown_range.h"

namespace pl::ui {
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
