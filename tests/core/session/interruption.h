// Interrupted work, for tests of sessions in the middle of a pass.
#pragma once

#include <algorithm>
#include <chrono>
#include <thread>

#include "core/base/timer.h"
#include "tests/support/session/sessions.h"

namespace pl::test {

/// Advances once while another thread raises the stop flag after the share delay^2 of the usual time of such work,
/// for `delay` in [0, 1]. That time is measured in earlier calls, so that stops interrupt the work on fast and on
/// slow machines alike.
inline Progress advance_interrupted(Session& session, float delay) {
    static double expected_seconds = 1.0e-3;
    StopFlag stop{false};
    std::thread other([&, share = static_cast<double>(delay * delay)] {
        std::this_thread::sleep_for(std::chrono::duration<double>(share * expected_seconds));
        stop = true;
    });
    const Stopwatch watch;
    const Progress progress = session.advance(slot_of(session), &stop);
    const double seconds = watch.seconds();
    other.join();
    if (progress == Progress::Stopped)
        expected_seconds = std::max(expected_seconds, seconds);
    else
        expected_seconds = 0.5 * (expected_seconds + seconds);
    return progress;
}

/// Whether the film's pass is incomplete.
inline bool pass_is_partial(const Session& session) {
    const Snapshot snapshot = session.snapshot(slot_of(session));
    return snapshot.counters.paths % snapshot.pixels.size() != 0;
}

/// Whether a slice of the radiance map is incomplete.
inline bool slice_is_partial(const Session& session) {
    const std::optional<FieldStatus> field = session.field_status(session.settings().method);
    return session.settings().method == MethodId::Precomputed && field &&
           field->records % static_cast<std::uint64_t>(field->volumes * field->bins) != 0;
}

/// Renders up to this number of passes; every second call is stopped before its work, the others within it. Returns the number of
/// the former that stopped work.
inline int render_with_stops(Session& session, std::uint32_t passes) {
    int stops = 0;
    for (int i = 0; session.passes(slot_of(session)) < passes; ++i) {
        StopFlag stop = true;
        if (i % 2 == 0)
            stops += session.advance(slot_of(session), &stop) == Progress::Stopped ? 1 : 0;
        else
            advance_interrupted(session, 0.6f);
    }
    return stops;
}

}  // namespace pl::test
