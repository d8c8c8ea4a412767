// Work that is stopped at some moment, so that tests can examine sessions in the middle of a pass.
#pragma once

#include <chrono>
#include <thread>

#include "tests/support/session/sessions.h"

namespace pl::test {

/// Advances once while another thread sets the stop flag after up to 4 milliseconds, for `delay` in [0, 1].
inline Progress advance_interrupted(Session& session, float delay) {
    StopFlag stop{false};
    std::thread other([&] {
        std::this_thread::sleep_for(std::chrono::microseconds(static_cast<int>(4000.0f * delay * delay)));
        stop = true;
    });
    const Progress progress = session.advance(slot_of(session), &stop);
    other.join();
    return progress;
}

/// Whether the film's pass is done in part.
inline bool pass_is_partial(const Session& session) {
    const Snapshot snapshot = session.snapshot(slot_of(session));
    return snapshot.counters.paths % snapshot.pixels.size() != 0;
}

/// Whether a slice of the radiance map is done in part.
inline bool slice_is_partial(const Session& session) {
    const std::optional<FieldStatus> field = session.field_status(session.settings().method);
    return session.settings().method == MethodId::Precomputed && field &&
           field->records % static_cast<std::uint64_t>(field->volumes * field->bins) != 0;
}

}  // namespace pl::test
