#include "app/run_passes.h"

#include <algorithm>

#include <fmt/format.h>

#include "app/progress.h"
#include "core/base/timer.h"
#include "core/session/methods.h"

namespace pl {
namespace {

class Passes {
public:
    Passes(Session& session, const Options& options, const StopFlag& stop, Until until, const RunAids& aids)
        : session_(session), slot_(slot_of(options.render)), options_(options), stop_(stop), until_(until),
          aids_(aids) {}

    RunOutcome run(ProgressDisplay& progress) {
        EndedBy end = limit_met(false);
        while (end == EndedBy::Nothing) {
            const Progress done = session_.advance(slot_, &stop_, most_passes());
            if (done == Progress::Stopped) return {EndedBy::Interruption, seconds()};
            end = limit_met(done == Progress::Rendered);
            if (end == EndedBy::Nothing && stop_) end = EndedBy::Interruption;
            if (end == EndedBy::Nothing && aids_.checkpoints != nullptr)
                aids_.checkpoints->save_if_due(session_, seconds());
            const ProgressState now = state();
            progress.show(now);
            if (aids_.show_progress) aids_.show_progress(now);
        }
        return {end, seconds()};
    }

private:
    double seconds() const {
        return watch_.seconds() + (aids_.checkpoints != nullptr ? aids_.checkpoints->earlier_seconds() : 0.0);
    }

    EndedBy limit_met(bool has_new_sample) const {
        if (until_ == Until::Learned && info_of(slot_.method).precomputes)
            return precomputed_share().value_or(0.0) >= 1.0 ? EndedBy::Learned : EndedBy::Nothing;
        if (session_.passes(slot_) == 0) return EndedBy::Nothing;
        if (has_new_sample && aids_.target != nullptr && aids_.target->is_met(session_, slot_))
            return EndedBy::TargetError;
        if (session_.passes(slot_) >= options_.spp_limit()) return EndedBy::Spp;
        const auto limit = options_.time_limit_seconds;
        return limit && seconds() >= *limit ? EndedBy::TimeLimit : EndedBy::Nothing;
    }

    /// Passes until the next one after which a limit is looked at; times are, whenever the back end has rendered as many as it
    /// takes at once.
    std::uint32_t most_passes() const {
        if (aids_.target != nullptr) return 1;
        const std::uint32_t passes = session_.passes(slot_);
        return passes < options_.spp_limit() ? options_.spp_limit() - passes : 1;
    }

    /// Empty before there are volumes.
    std::optional<double> precomputed_share() const {
        const std::optional<FieldStatus> field = session_.field_status(slot_.method);
        return field ? std::optional(field->precomputed_share) : std::nullopt;
    }

    /// Share of the limit that is nearest.
    double share_done() const {
        double share = static_cast<double>(session_.passes(slot_)) / options_.spp_limit();
        if (options_.time_limit_seconds) share = std::max(share, seconds() / *options_.time_limit_seconds);
        if (aids_.target != nullptr) share = std::max(share, aids_.target->share_done());
        return std::min(share, 1.0);
    }

    std::string limit_text() const {
        const bool has_limit = options_.spp || !(options_.time_limit_seconds || options_.target_error);
        std::string text = has_limit ? fmt::format("{}/{} spp", session_.passes(slot_), options_.spp_limit())
                                     : fmt::format("{} spp", session_.passes(slot_));
        text += fmt::format(", {}", duration_text(seconds()));
        if (aids_.target != nullptr && aids_.target->measured())
            text += fmt::format(", noise {:.2g} of {:.2g}", *aids_.target->measured(), aids_.target->target());
        return text;
    }

    ProgressState state() const {
        const double precomputed = precomputed_share().value_or(1.0);
        if (precomputed < 1.0 && session_.passes(slot_) == 0)
            return {.activity = "precomputing",
                    .share = precomputed,
                    .spp = 0,
                    .detail = fmt::format("{}", duration_text(seconds()))};
        return {
            .activity = "rendering", .share = share_done(), .spp = session_.passes(slot_), .detail = limit_text()};
    }

    Session& session_;
    const FilmSlot slot_;
    const Options& options_;
    const StopFlag& stop_;
    Until until_;
    const RunAids& aids_;
    Stopwatch watch_;
};

}  // namespace

void announce(const Session& session, Console& console) {
    const BackendInfo backend = session.backend();
    const FilmSlot slot = slot_of(session.settings());
    console.log().detail(fmt::format("{} on {} ({} threads, rays by {})", backend.name, backend.device,
                                     backend.threads, backend.intersector));
    console.log().detail(fmt::format("kernel {}", session.served_kernel(slot).name));
    console.event("start", {{"scene", session.scene().source.string()},
                            {"method", info_of(slot.method).name},
                            {"view", info_of(slot.view).name},
                            {"backend", backend.name},
                            {"width", session.settings().width},
                            {"height", session.settings().height},
                            {"kernel", session.served_kernel(slot).name}});
}

RunOutcome run_passes(Session& session, const Options& options, const StopFlag& stop, Console& console, Until until,
                      const RunAids& aids) {
    ProgressDisplay progress(console, !options.no_progress && !options.quiet);
    return Passes(session, options, stop, until, aids).run(progress);
}

}  // namespace pl
