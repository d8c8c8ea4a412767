// Precomputation: paths that start at a radiance volume instead of the camera and end in its table.
#pragma once

#include "core/kernel/fields/reach.h"
#include "core/kernel/integrator/steps.h"
#include "core/kernel/methods/default.h"

namespace pl {

/// Which sets of effects the kernels of a precomputation are compiled for.
inline constexpr KernelRange kProbeRange = KernelRange::Sparse;

/// Goes on as DefaultMethod does and remembers how far the first segment led.
struct ProbeMethod : DefaultMethod {
    struct Memory {
        float distance = 0.0f;
        float roulette_weight = 1.0f;
    };

    PL_HD Memory remember(const Vertex&, const DirectionSample&) const { return {}; }
    PL_HD Record learn(Memory& memory, const Arrival& arrival, const Vertex&, MethodCounters&) const {
        if (memory.distance == 0.0f) memory.distance = arrival.distance;
        return {};
    }
    PL_HD void depart(Memory&, const Vertex&, const Scattering&, MethodCounters&) const {}
    PL_HD void request_light(Memory&, Vec3f) const {}
    PL_HD void receive_light(Memory&, MethodCounters&) const {}
    PL_HD void stop(Memory&, MethodCounters&) const {}
    PL_HD void finish(Memory&, MethodCounters&) const {}
};
static_assert(FollowingMethod<ProbeMethod>);

/// Which table entry a probe path measures. Probes are numbered volume-major, then by cell.
struct ProbeTarget {
    std::int32_t volume;
    int cell;
};

PL_HD inline ProbeTarget probe_target(const TableField& field, std::uint32_t probe) {
    const auto cells = static_cast<std::uint32_t>(field.cells.count());
    return {static_cast<std::int32_t>(probe / cells), static_cast<int>(probe % cells)};
}

/// Starts a path that measures the radiance arriving through one cell. Directions are stratified: sample s of S
/// (a square number) takes one of S sub-cells. `u` is drawn for vertex 0 and Purpose::Probe.
template <FeatureSet F>
PL_HD inline PathState<F, ProbeMethod> begin_probe(const TableField& field, std::uint32_t probe, std::uint32_t sample,
                                                   std::uint32_t strata_side, Vec4f u) {
    const ProbeTarget target = probe_target(field, probe);
    const Vec2f stratum{static_cast<float>(sample % strata_side), static_cast<float>(sample / strata_side)};
    const Vec2f in_cell = (stratum + Vec2f{u.x, u.y}) * (1.0f / static_cast<float>(strata_side));
    const Vec3f local = square_to_cosine_hemisphere(field.cells.point_in_cell(target.cell, in_cell));
    PathState<F, ProbeMethod> state;
    state.ray =
        spawn_ray(field.sites[static_cast<std::uint32_t>(target.volume)], field.frame(target.volume).to_world(local));
    state.pixel = probe;
    state.sample = sample;
    return state;
}

template <FeatureSet F>
PL_HD inline PathState<F, ProbeMethod> begin_probe(const TableField& field, const PathSettings& settings,
                                                   std::uint32_t probe, std::uint32_t sample,
                                                   std::uint32_t strata_side) {
    const Vec4f u = path_rng(settings, probe, sample).draw(0, Purpose::Probe);
    return begin_probe<F>(field, probe, sample, strata_side, u);
}

/// Stores what a finished probe path brought.
template <FeatureSet F>
PL_HD inline void finish_probe(const TableField& field, const PathState<F, ProbeMethod>& state,
                               MethodCounters& counters) {
    constexpr float kWeightPerUnit = 256.0f;  // before anything is published nobody knows what is much
    const ProbeTarget target = probe_target(field, state.pixel);
    const float light = luminance(state.radiance);
    record(field, target.volume, target.cell, light);
    counters.clamped_records += is_clamped(light, field.radiance_unit) ? 1u : 0u;
    record_reach(field, target.volume, kWeightPerUnit * (light / field.radiance_unit), state.memory.distance);
}

}  // namespace pl
