#include "core/measure/error_target.h"

#include <algorithm>

#include "core/base/timer.h"
#include "core/measure/noise.h"
#include "core/measure/run_recorder.h"

namespace pl {

bool ErrorTarget::is_met(const Session& session, FilmSlot slot) {
    const std::uint32_t passes = session.passes(slot);
    if (passes < std::max(next_passes_, kFewestSamples) || !budget_.allows(charged_seconds(session.clocks(slot))))
        return false;
    next_passes_ = passes + std::max(passes / 10, 1u);
    measure(session, slot);
    return is_low_enough();
}

void ErrorTarget::measure_last(const Session& session, FilmSlot slot) {
    if (session.passes(slot) != measured_passes_) measure(session, slot);
}

double ErrorTarget::share_done() const {
    return measured_ && *measured_ > 0.0 ? std::min(target_ / *measured_, 1.0) : 0.0;
}

void ErrorTarget::measure(const Session& session, FilmSlot slot) {
    const Stopwatch watch;
    measured_ = std::nullopt;
    measured_passes_ = session.passes(slot);
    if (const Snapshot snapshot = session.snapshot_with_halves(slot); snapshot.halves.are_both_there()) {
        const Noise noise = estimate_noise(halves_of(snapshot.halves), snapshot.width, measuring_threads(session));
        if (noise.pixels > 0) measured_ = noise.relmse;
    }
    budget_.spend(watch.seconds());
}

}  // namespace pl
