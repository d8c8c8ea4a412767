#include "ui/model/diagnostics_finder.h"

namespace pl::ui {

void DiagnosticsFinder::begin(DiagnosticsAnswer answer) {
    is_asked_ = false;
    if (!answer.source) return;
    generation_ = answer.generation;
    job_ = std::make_unique<BackgroundJob<Found>>([source = std::move(*answer.source)](const JobMonitor& monitor) {
        return std::make_shared<const diagnose::DiagnosticsMap>(
            diagnose::find_diagnostics(source, 0, monitor.stop, [&](double share) { monitor.progress(share, ""); }));
    });
}

void DiagnosticsFinder::stop() {
    if (job_) job_->stop();
}

std::optional<BackgroundJob<DiagnosticsFinder::Found>::Result> DiagnosticsFinder::update(std::uint64_t generation) {
    const bool is_other = generation > generation_;  // the status may be older than the answer of the render thread
    if (is_other) {
        stop();
        drop();
    }
    if (!job_) return std::nullopt;
    auto result = job_->take_result();
    if (!result) return std::nullopt;
    job_.reset();
    if (is_other) result->value.reset();
    map_ = result->value;
    return result;
}

DiagnosticsFinder::Found DiagnosticsFinder::map_of(const PublishedFrame& frame) const {
    const bool fits = map_ && frame.generation == generation_ && frame.snapshot.width == map_->width &&
                      frame.snapshot.height == map_->height;
    return fits ? map_ : nullptr;
}

}  // namespace pl::ui
