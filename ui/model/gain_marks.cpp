#include "ui/model/gain_marks.h"

#include <algorithm>

#include "core/base/timer.h"
#include "core/measure/run_recorder.h"

namespace pl::ui {
namespace {

constexpr double kLeastMarkInterval = 1.0;  ///< seconds
constexpr double kMarkRest = 20.0;          ///< seconds of rest for each of work

TimedHalves timed_halves(const Snapshot& snapshot) {
    return {.halves = halves_of(snapshot.halves), .seconds = charged_seconds(snapshot.clocks)};
}

}  // namespace

void GainMarks::set_shown(bool shown) {
    is_shown_ = shown;
    drop();
}

void GainMarks::drop() {
    job_.reset();
    is_asked_ = false;
    next_seconds_ = 0.0;
    asked_serial_ = 0;
    reason_.clear();
    result_.reset();
}

void GainMarks::take_answer() {
    const std::optional<GainAnswer> answer = link_.worker().take<GainAnswer>();
    if (!answer || !is_asked_) return;
    is_asked_ = false;
    reason_ = answer->reason;
    if (!answer->value[0]) {
        result_.reset();
        return;
    }
    job_ = std::make_unique<Comparison>([base = answer->value[0], method = answer->value[1]](const JobMonitor&) {
        const Stopwatch watch;
        auto result = std::make_shared<Result>();
        result->gains = tile_gains(timed_halves(*base), timed_halves(*method), method->width);
        result->method = method->slot.method;
        result->passes = {base->passes, method->passes};
        result->seconds = watch.seconds();
        return std::shared_ptr<const Result>(std::move(result));
    });
}

void GainMarks::take_result(double seconds) {
    if (!job_) return;
    auto result = job_->take_result();
    if (!result) return;
    job_.reset();
    reason_ = result->failure;
    result_ = result->value;
    if (result_) next_seconds_ = seconds + std::max(kLeastMarkInterval, kMarkRest * result_->seconds);
}

void GainMarks::update(double seconds) {
    take_answer();
    take_result(seconds);
    const PublishedFrame* frame = link_.frame().get();
    if (!is_shown_ || frame == nullptr || is_asked_ || job_ || seconds < next_seconds_) return;
    if (frame->serial == asked_serial_ || link_.status().picture == 0) return;
    asked_serial_ = frame->serial;
    picture_ = link_.status().picture;
    next_seconds_ = seconds + kLeastMarkInterval;
    is_asked_ = true;
    link_.worker().request_gain();
}

bool GainMarks::is_old() const {
    const PublishedFrame* frame = link_.frame().get();
    if (!result_ || frame == nullptr) return false;
    const bool is_base = frame->snapshot.slot.method == baseline_method();
    return pl::is_old(result_->passes[is_base ? 0 : 1], frame->snapshot.passes);
}

const TileGains* GainMarks::gains() const {
    return result_ && link_.status().picture == picture_ ? &result_->gains : nullptr;
}

}  // namespace pl::ui
