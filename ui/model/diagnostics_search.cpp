#include "ui/model/diagnostics_search.h"

namespace pl::ui {

std::shared_ptr<const diagnose::DiagnosticsMap> DiagnosticsSearch::map() const {
    const auto& frame = link_.frame();
    const bool fits = frame && map_ && frame->generation == generation_ && frame->snapshot.width == map_->width &&
                      frame->snapshot.height == map_->height;
    return fits ? map_ : nullptr;
}

std::optional<double> DiagnosticsSearch::share() const {
    if (!is_searching()) return std::nullopt;
    return job_ ? job_->progress().share : 0.0;
}

void DiagnosticsSearch::toggle() {
    if (is_searching()) {
        if (job_) job_->stop();
    } else if (map()) {
        map_.reset();
    } else {
        start();
    }
}

void DiagnosticsSearch::start() {
    link_.end_turns(render_.method());
    is_asked_ = true;
    link_.worker().request_diagnostics();
    link_.hold(RenderLink::Hold::Diagnostics, true);
}

/// The render thread has answered: the search begins, unless the picture has no paths.
void DiagnosticsSearch::begin(DiagnosticsAnswer answer) {
    is_asked_ = false;
    if (!answer.value) {
        messages_.say(MessageLevel::Info, answer.reason);
        return;
    }
    generation_ = answer.generation;
    job_ = std::make_unique<BackgroundJob<Found>>([source = std::move(*answer.value)](const JobMonitor& monitor) {
        return std::make_shared<const diagnose::DiagnosticsMap>(
            diagnose::find_diagnostics(source, 0, monitor.stop, [&](double share) { monitor.progress(share, ""); }));
    });
}

void DiagnosticsSearch::end(BackgroundJob<Found>::Result result) {
    job_.reset();
    map_ = std::move(result.value);
    link_.hold(RenderLink::Hold::Diagnostics, is_searching());
    if (!result.failure.empty())
        messages_.say(MessageLevel::Error, "the search for invalid samples failed: " + result.failure);
    else if (map_)
        messages_.say(MessageLevel::Info, summary_of(*map_));
}

void DiagnosticsSearch::update() {
    if (auto answer = link_.worker().take<DiagnosticsAnswer>()) {
        begin(std::move(*answer));
        link_.hold(RenderLink::Hold::Diagnostics, is_searching());
    }
    const bool is_other = link_.status().generation > generation_;  // the status may be older than the answer
    if (is_other) {
        if (job_) job_->stop();
        map_.reset();
    }
    if (!job_) return;
    auto result = job_->take_result();
    if (!result) return;
    if (is_other) result->value.reset();
    end(std::move(*result));
}

}  // namespace pl::ui
