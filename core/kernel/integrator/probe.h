// Precomputation: paths that start at a radiance volume instead of the camera and end in its table.
#pragma once

#include "core/kernel/fields/field_view.h"
#include "core/kernel/integrator/steps.h"
#include "core/kernel/methods/default.h"

namespace pl {

/// Which table entry a probe path measures. Probes are numbered volume-major, then by cell.
struct ProbeTarget {
    std::int32_t volume;
    int cell;
};

PL_HD inline ProbeTarget probe_target(const FieldView& field, std::uint32_t probe) {
    const auto cells = static_cast<std::uint32_t>(field.cells.count());
    return {static_cast<std::int32_t>(probe / cells), static_cast<int>(probe % cells)};
}

/// Starts a path that measures the radiance arriving through one cell. Directions are stratified: sample s of S
/// (a square number) takes one of S sub-cells. `u` is drawn for vertex 0 and Purpose::Probe.
PL_HD inline PathState<DefaultMethod> begin_probe(const FieldView& field, std::uint32_t probe, std::uint32_t sample,
                                                  std::uint32_t strata_side, Vec4f u) {
    const ProbeTarget target = probe_target(field, probe);
    const Vec2f stratum{static_cast<float>(sample % strata_side), static_cast<float>(sample / strata_side)};
    const Vec2f in_cell = (stratum + Vec2f{u.x, u.y}) * (1.0f / static_cast<float>(strata_side));
    const Vec3f local = square_to_cosine_hemisphere(field.cells.point_in_cell(target.cell, in_cell));
    PathState<DefaultMethod> state;
    state.ray =
        spawn_ray(field.sites[static_cast<std::uint32_t>(target.volume)], field.frame(target.volume).to_world(local));
    state.pixel = probe;
    state.sample = sample;
    return state;
}

PL_HD inline PathState<DefaultMethod> begin_probe(const FieldView& field, const PathSettings& settings,
                                                  std::uint32_t probe, std::uint32_t sample,
                                                  std::uint32_t strata_side) {
    const Vec4f u = path_rng(settings, probe, sample).draw(0, Purpose::Probe);
    return begin_probe(field, probe, sample, strata_side, u);
}

/// Stores what a finished probe path brought.
PL_HD inline void finish_probe(const FieldView& field, const PathState<DefaultMethod>& state) {
    const ProbeTarget target = probe_target(field, state.pixel);
    record(field, target.volume, target.cell, luminance(state.radiance));
}

}  // namespace pl
