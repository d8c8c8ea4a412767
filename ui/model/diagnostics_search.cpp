#include "ui/model/diagnostics_search.h"

namespace pl::ui {

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
