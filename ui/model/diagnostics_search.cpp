#include "ui/model/diagnostics_search.h"

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

std::shared_ptr<const diagnose::DiagnosticsMap> DiagnosticsSearch::map() const {
    return link_.frame() ? finder_.map_of(*link_.frame()) : nullptr;
}

std::optional<double> DiagnosticsSearch::share() const {
    return finder_.is_searching() ? std::optional(finder_.share()) : std::nullopt;
}

void DiagnosticsSearch::toggle() {
    if (finder_.is_searching())
        finder_.stop();
    else if (map())
        finder_.drop();
    else
        start();
}

void DiagnosticsSearch::start() {
    link_.end_turns(render_.method());
    finder_.expect_answer();
    link_.worker().request_diagnostics();
    link_.hold(RenderLink::Hold::Diagnostics, true);
}

void DiagnosticsSearch::update() {
    if (auto answer = link_.worker().take_diagnostics()) {
        if (!answer->source) messages_.say(MessageLevel::Info, answer->reason);
        finder_.begin(std::move(*answer));
        link_.hold(RenderLink::Hold::Diagnostics, finder_.is_searching());
    }
    const auto result = finder_.update(link_.status().generation);
    if (!result) return;
    link_.hold(RenderLink::Hold::Diagnostics, finder_.is_searching());
    if (!result->failure.empty())
        messages_.say(MessageLevel::Error, "the search for invalid samples failed: " + result->failure);
    else if (result->value)
        messages_.say(MessageLevel::Info, summary_of(*result->value));
}

}  // namespace pl::ui
