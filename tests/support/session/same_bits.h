// Rule S4: equality of films, counters and tables down to the bit.
#pragma once

#include <cstring>

#include "tests/support/same_bits.h"
#include "tests/support/session/sessions.h"

namespace pl::test {

/// Every array, so that a new one is compared as well.
template <class Arrays>
bool same_arrays(const Arrays& a, const Arrays& b) {
    bool same = true;
    zip(a, b, [&](const auto& x, const auto& y) { same = same && same_bits(x, y); });
    return same;
}
inline bool same_bits(const HostTables& a, const HostTables& b) { return same_arrays(a, b); }

/// Calls fn(array of a, array of b) for the arrays of fields of one representation. Returns whether they have one.
template <class Fn>
bool zip_alike(const HostField& a, const HostField& b, Fn&& fn) {
    return std::visit(
        [&](const auto& x, const auto& y) {
            constexpr bool kAlike = std::is_same_v<decltype(x), decltype(y)>;
            if constexpr (kAlike) zip(x, y, fn);
            return kAlike;
        },
        a, b);
}
inline bool same_bits(const HostField& a, const HostField& b) {
    bool same = true;
    return zip_alike(a, b, [&](const auto& x, const auto& y) { same = same && same_bits(x, y); }) && same;
}

inline bool same_events(const PassCounters& a, const PassCounters& b) {
    static_assert(std::has_unique_object_representations_v<PassCounters>);
    return std::memcmp(&a, &b, sizeof a) == 0;
}

/// A film with its statistics, and the arrays of its method: tables, or another representation.
struct State {
    Snapshot snapshot;
    HostTables tables;
    HostField other{};
};

inline State state_of(Session& session, FilmSlot slot) {
    HostField field = session.backend_access().download_field(slot.method);
    State state{session.snapshot_with_halves(slot), {}};
    if (std::holds_alternative<HostTables>(field))
        state.tables = tables_of(std::move(field));
    else
        state.other = std::move(field);
    return state;
}
inline State state_of(Session& session) { return state_of(session, slot_of(session)); }

inline State state_after(Session session, std::uint32_t passes) {
    render_passes(session, passes);
    return state_of(session);
}

inline bool same_film(const State& a, const State& b) {
    const FilmHalves& x = a.snapshot.halves;
    const FilmHalves& y = b.snapshot.halves;
    return a.snapshot.passes == b.snapshot.passes && same_bits(a.snapshot.pixels, b.snapshot.pixels) &&
           x.weights == y.weights && same_bits(x.mean[0], y.mean[0]) && same_bits(x.mean[1], y.mean[1]);
}
inline bool same_state(const State& a, const State& b) {
    return same_film(a, b) && same_events(a.snapshot.counters, b.snapshot.counters) &&
           same_bits(a.tables, b.tables) && same_bits(a.other, b.other);
}

}  // namespace pl::test
