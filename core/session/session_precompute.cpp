// The part of Session that fills the precomputed map. For a film that warms up the map stays coarse until guiding is chosen, and as long
// as it does not pay: the probes of the first quarter are enough to find out, and the others take as long as several passes.
#include <cmath>

#include "core/base/timer.h"
#include "core/kernel/integrator/probe.h"
#include "core/session/path_settings.h"
#include "core/session/session.h"

namespace pl {

std::uint32_t Session::probe_count() const {
    return static_cast<std::uint32_t>(placement_.count()) * static_cast<std::uint32_t>(placement_.bins());
}

std::uint32_t Session::coarse_probe_count() const {
    const ProbeQuarter first = ProbeQuarter::of(placement_.shape().cells.side, 0);
    return static_cast<std::uint32_t>(placement_.count()) * first.probes_of_volume();
}

bool Session::is_map_complete(MethodId method) const {
    return field(method).precomputed_slices >= static_cast<std::uint32_t>(settings_.field.precompute_samples);
}

/// Whether the trials and passes that come next need no more than a coarse map. Views of the map show all of it.
bool Session::coarse_map_suffices(FilmSlot slot) const {
    const GuidingChoice& guiding = films_[slot].guiding;
    return warms_up(slot) && (guiding.is_warming_up() || !guiding.pays());
}

bool Session::needs_precompute(FilmSlot slot) const {
    const bool shows_field = slot.view == View::Beauty || info_of(slot.view).needs_tables;
    if (!shows_field || !info_of(slot.method).precomputes || is_map_complete(slot.method)) return false;
    const FieldProgress& map = field(slot.method);
    return !coarse_map_suffices(slot) || (map.precomputed_slices == 0 && map.next_probe < coarse_probe_count());
}

/// Traces the probes of a coarse map, or those of a slice that are left.
Progress Session::precompute_slice(FilmSlot slot, const StopFlag* stop) {
    const Stopwatch watch;
    FieldProgress& map = field(slot.method);
    const auto slices = static_cast<std::uint32_t>(settings_.field.precompute_samples);
    const std::uint32_t end = coarse_map_suffices(slot) ? coarse_probe_count() : probe_count();
    const PassCounters counters =
        backend_->precompute({.method = slot.method,
                              .features = needed_features(slot).with(settings_.forced_effects),
                              .path = probe_settings(settings_, slot.method),
                              .sample = map.precomputed_slices,
                              .strata_side = static_cast<std::uint32_t>(std::lround(std::sqrt(slices))),
                              .first_probe = map.next_probe,
                              .end_probe = end,
                              .stop = stop});
    map.records += counters.paths;
    map.clamped_records += counters.path.method.clamped_records;
    map.next_probe += static_cast<std::uint32_t>(counters.paths);
    const bool is_reached = map.next_probe >= end;
    if (is_reached && end == probe_count()) {
        map.next_probe = 0;
        ++map.precomputed_slices;
        if (is_map_complete(slot.method)) ++map.passes;
    }
    if (is_reached && (map.next_probe > 0 || is_map_complete(slot.method))) {
        backend_->update_field(slot.method);
        ++map.updates;
    }
    map.precompute_seconds += watch.seconds();
    return is_reached ? Progress::Precomputed : Progress::Stopped;
}

}  // namespace pl
