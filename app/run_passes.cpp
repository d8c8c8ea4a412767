#include "app/run_passes.h"

#include <algorithm>

#include <fmt/format.h>

#include "app/progress.h"
#include "core/base/timer.h"

namespace pl {
namespace {

/// The larger one of the shares of both limits.
double share_done(const Session& session, const Options& options, double seconds) {
    double share = static_cast<double>(session.passes()) / options.spp_limit();
    if (options.time_limit_seconds) share = std::max(share, seconds / *options.time_limit_seconds);
    return std::min(share, 1.0);
}

std::string limit_text(const Session& session, const Options& options, double seconds) {
    const std::string spp = options.spp || !options.time_limit_seconds
                                ? fmt::format("{}/{} spp", session.passes(), options.spp_limit())
                                : fmt::format("{} spp", session.passes());
    return fmt::format("{}, {}", spp, duration_text(seconds));
}

ProgressState progress_of(const Session& session, const Options& options, double seconds) {
    const double precomputed = session.field_status() ? session.field_status()->precomputed_share : 1.0;
    if (precomputed < 1.0 && session.passes() == 0)
        return {.activity = "precomputing",
                .share = precomputed,
                .spp = 0,
                .detail = fmt::format("{}", duration_text(seconds))};
    return {.activity = "rendering",
            .share = share_done(session, options, seconds),
            .spp = session.passes(),
            .detail = limit_text(session, options, seconds)};
}

bool is_done(const Session& session, const Options& options, double seconds, Until until) {
    if (until == Until::Learned && session.settings().method == MethodId::Precomputed)
        return session.field_status() && session.field_status()->precomputed_share >= 1.0;
    if (session.passes() == 0) return false;
    return session.passes() >= options.spp_limit() ||
           (options.time_limit_seconds && seconds >= *options.time_limit_seconds);
}

}  // namespace

RunOutcome run_passes(Session& session, const Options& options, const InterruptGuard& interrupt, Console& console,
                      Until until) {
    ProgressDisplay progress(console, !options.no_progress && !options.quiet);
    const Stopwatch watch;
    while (!is_done(session, options, watch.seconds(), until)) {
        const bool stopped = session.advance(interrupt.flag()) == Progress::Stopped;
        const double seconds = watch.seconds();
        if (stopped || (interrupt.raised() && !is_done(session, options, seconds, until)))
            return {.interrupted = true, .seconds = seconds};
        progress.show(progress_of(session, options, seconds));
    }
    return {.interrupted = false, .seconds = watch.seconds()};
}

}  // namespace pl
