// Precomputation: probe paths start at a radiance volume instead of the camera and train one cell of its table.
#pragma once

#include "core/kernel/guiding/reach.h"
#include "core/kernel/guiding/table_field.h"
#include "core/kernel/integrator/steps.h"
#include "core/kernel/methods/default.h"

namespace pl {

/// Sets of features that the kernels of a precomputation are compiled for.
inline constexpr KernelRange kProbeRange = KernelRange::Sparse;

/// Default path tracing that keeps the length of the first segment.
struct ProbeMethod : DefaultMethod {
    struct Memory {
        float distance = 0.0f;
    };

    PL_HD Sample observe(Memory& memory, const Observation& observation, const Vertex&, MethodCounters&) const {
        if (memory.distance == 0.0f) memory.distance = observation.distance;
        return {};
    }
};
static_assert(Method<ProbeMethod>);

/// One of each 2 x 2 cells of every volume. Probes are numbered by quarters, so that the probes of the first quarter
/// alone make a coarse map; within a quarter volume-major, then by cell.
struct ProbeQuarter {
    int x, y;           ///< of its cell in each block, 0 or 1
    int columns, rows;  ///< blocks of a volume

    PL_HD static ProbeQuarter of(int side, int number) {
        const int x = number == 1 || number == 2 ? 1 : 0;  // the second cell is diagonal to the first
        const int y = number == 1 || number == 3 ? 1 : 0;
        return {x, y, (side + 1 - x) / 2, (side + 1 - y) / 2};
    }
    PL_HD std::uint32_t probes_of_volume() const { return static_cast<std::uint32_t>(columns * rows); }
    PL_HD int cell(int side, int block) const {
        return (2 * (block / columns) + y) * side + 2 * (block % columns) + x;
    }
};

PL_HD inline std::uint32_t probe_count(const TableView& field) {
    return field.normals.count * static_cast<std::uint32_t>(field.cells.count());
}

/// The cell that a probe measures.
PL_HD inline TableEntry probe_target(const TableView& field, std::uint32_t probe) {
    const int side = field.cells.side;
    ProbeQuarter quarter = ProbeQuarter::of(side, 0);
    for (int next = 1; next < 4 && probe >= field.normals.count * quarter.probes_of_volume(); ++next) {
        probe -= field.normals.count * quarter.probes_of_volume();
        quarter = ProbeQuarter::of(side, next);
    }
    const std::uint32_t per_volume = quarter.probes_of_volume();
    return {static_cast<std::int32_t>(probe / per_volume), quarter.cell(side, static_cast<int>(probe % per_volume))};
}

/// Sample `index` of strata_side^2 of every probe.
struct ProbeStratum {
    std::uint32_t index = 0;
    std::uint32_t strata_side = 1;
};

/// Starts a path that measures the radiance incident through one cell. Its direction is stratified over the cell. `u` is drawn
/// for vertex 0 and Purpose::Probe. Where lights are sampled, emission of the first surface hit gets the MIS weight of a
/// Lambert BSDF at the volume: paths guided by the map sample lights there, too.
template <FeatureSet F>
PL_HD inline PathState<F, ProbeMethod> begin_probe(const TableView& field, std::uint32_t probe, ProbeStratum stratum,
                                                   Vec4f u) {
    const TableEntry target = probe_target(field, probe);
    const Vec2f corner{static_cast<float>(stratum.index % stratum.strata_side),
                       static_cast<float>(stratum.index / stratum.strata_side)};
    const Vec2f in_cell = (corner + Vec2f{u.x, u.y}) * (1.0f / static_cast<float>(stratum.strata_side));
    const Vec3f local = square_to_cosine_hemisphere(field.cells.point_in_cell(target.cell, in_cell));
    PathState<F, ProbeMethod> state;
    state.ray =
        spawn_ray(field.sites[static_cast<std::uint32_t>(target.volume)], field.frame(target.volume).to_world(local));
    state.direction_pdf_sa = local.z * kInvPi;
    state.pixel = probe;
    state.sample = stratum.index;
    return state;
}

template <FeatureSet F>
PL_HD inline PathState<F, ProbeMethod> begin_probe(const TableView& field, const PathSettings& settings,
                                                   std::uint32_t probe, ProbeStratum stratum) {
    return begin_probe<F>(field, probe, stratum, path_rng(settings, probe, stratum.index).draw(0, Purpose::Probe));
}

/// Records the radiance of a finished probe path.
template <FeatureSet F>
PL_HD inline void finish_probe(const TableView& field, const PathState<F, ProbeMethod>& state,
                               MethodCounters& counters) {
    constexpr float kWeightPerUnit = 256.0f;  // before the first update there is no mean radiance to be relative to
    const TableEntry target = probe_target(field, state.pixel);
    const float radiance = rms(state.radiance);
    record(field, target.volume, target.cell, radiance);
    counters.clamped_records += is_clamped(radiance, field.radiance_unit) ? 1u : 0u;
    record_reach(field, target.volume, kWeightPerUnit * (radiance / field.radiance_unit), state.memory.distance);
}

}  // namespace pl
