#include "ui/worker/motion_resolution.h"

#include <algorithm>

namespace pl::ui {

void MotionResolution::observe(int divider, double seconds) {
    if (!(seconds > 0.0)) return;
    // A pass takes time in proportion to its pixels.
    const auto predicted = [&](int other) {
        const double ratio = static_cast<double>(divider) / other;
        return seconds * ratio * ratio;
    };
    if (predicted(divider_) > kTargetSeconds * (1.0 + kDeadBand)) {
        while (divider_ < kMaxDivider && predicted(divider_) > kTargetSeconds) divider_ *= 2;
    } else {
        while (divider_ > 1 && predicted(divider_ / 2) < kTargetSeconds * (1.0 - kDeadBand)) divider_ /= 2;
    }
}

int MotionResolution::divider_for(int width, int height) const {
    int divider = divider_;
    while (divider > 1 && std::max(width, height) / divider < kMinLongSide) divider /= 2;
    return divider;
}

}  // namespace pl::ui
