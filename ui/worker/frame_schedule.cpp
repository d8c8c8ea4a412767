#include "ui/worker/frame_schedule.h"

namespace pl::ui {

bool FrameSchedule::is_due(std::uint32_t passes, bool is_moving, double rendered_seconds) const {
    if (passes == 0 || shows(passes)) return false;
    return is_moving || !age_ || age_->seconds() >= frame_interval(rendered_seconds);
}

void FrameSchedule::settle(const Requests& now) {
    display_ = now.display;
    has_values_ = now.values;
    is_denoised_ = now.denoised;
}

void FrameSchedule::end(std::uint32_t passes) {
    passes_ = passes;
    age_.emplace();
}

}  // namespace pl::ui
