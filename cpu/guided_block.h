// Paths of a guided method on their way from one segment to the next: what they have to leave where they stand, and the
// directions that are chosen for all of them at once.
#pragma once

#include "core/kernel/integrator/steps.h"
#include "cpu/guided_records.h"
#include "cpu/lane_kernels.h"
#include "cpu/lookups_ahead.h"

namespace pl {

inline constexpr std::uint32_t kGuidedGroups = group_count(kGuidedBlock);

/// At most kGuidedBlock paths. Gives every path what M::sample_direction would alone.
template <FeatureSet F, GuidedMethod M>
class GuidedDepartures {
public:
    GuidedDepartures(const M& method, const PathSettings& settings) : method_(method), settings_(settings) {}

    std::uint32_t count() const { return count_; }
    void clear() { count_ = 0; }

    /// Where the next path may put down its departure; add() makes it count.
    Departure<F, M>& next() { return departures_[count_]; }
    void add(std::uint32_t path, const PathState<F, M>& state, Vec4f u) {
        const Departure<F, M>& departure = departures_[count_];
        const GuidedVertex& vertex = departure.vertex;
        GuidedGroup& group = groups_[count_ / kGroupSize];
        const std::uint32_t lane = count_ % kGroupSize;
        group.volume[lane] = kNoVolume;
        if (vertex.volume != kNoVolume) {
            __builtin_prefetch(method_.field.row_cdf.data + vertex.volume * method_.field.cells.side);
            group.set_volume(lane, serving_volume(vertex));
        }
        group.position.set(lane, departure.surface.position);
        group.shading_normal.set(lane, departure.surface.shading_normal);
        group.choice[lane] = u.x;
        group.u_x[lane] = u.y;
        group.u_y[lane] = u.z;
        group.counters.pixel[lane] = state.pixel;
        group.counters.sample[lane] = state.sample;
        group.counters.vertex[lane] = state.draw_index();
        paths_[count_++] = path;
        if (lane + 1 == kGroupSize) choose_rows();
    }

    void choose_directions() {
        if (count_ % kGroupSize != 0) choose_rows();
        kernels_.sample_guided(mixture(), {settings_.seed, settings_.stream, Purpose::CellJitter}, groups_, chosen_,
                               directions_, group_count(count_));
    }

    std::uint32_t path(std::uint32_t i) const { return paths_[i]; }
    const Departure<F, M>& departure(std::uint32_t i) const { return departures_[i]; }
    DirectionSample direction(std::uint32_t i) const { return directions_[i / kGroupSize].get(i % kGroupSize); }

private:
    /// By the node that the lookup has just read, if it is known.
    ServingVolume<One> serving_volume(const GuidedVertex& vertex) const {
        if (vertex.node == FoundVolume::kUnknown) return method_.serving_volume(vertex.volume);
        const KdNode& node = method_.field.tree.nodes[vertex.node];
        return method_.serving_volume(vertex.volume, node.position, node.normal);
    }
    /// Of the last group.
    void choose_rows() {
        const std::uint32_t group = (count_ - 1) / kGroupSize;
        kernels_.choose_rows(mixture(), groups_[group], chosen_[group]);
    }
    GuidedMixture mixture() const { return method_.field.normals.empty() ? kNoTables : method_.mixture_view(); }

    /// Something to load for paths that no volume serves, where there is none at all.
    static constexpr float kOneCell[] = {1.0f};
    static constexpr GuidedMixture kNoTables{.cells = {1}, .row_cdf = kOneCell, .column_cdf = kOneCell};

    const M& method_;
    const PathSettings& settings_;
    LaneKernels kernels_ = best_lane_kernels();
    std::uint32_t count_ = 0;
    std::uint32_t paths_[kGuidedBlock];
    Departure<F, M> departures_[kGuidedBlock];
    GuidedGroup groups_[kGuidedGroups];
    ChosenGroup chosen_[kGuidedGroups];
    DirectionGroup directions_[kGuidedGroups];
};

/// What the threads of a pass share besides scene and tables, and what each needs to extend blocks of paths; nothing for
/// methods that are not guided.
template <class M>
struct SharedByThreads {
    explicit SharedByThreads(const M&) {}
};
template <GuidedMethod M>
struct SharedByThreads<M> {
    VolumeLocks locks;

    explicit SharedByThreads(const M& method) : locks(method.field.normals.count) {}
};

template <FeatureSet F, class M>
struct BlockMemory {
    BlockMemory(const M&, const PathSettings&, SharedByThreads<M>&) {}
};
template <FeatureSet F, GuidedMethod M>
struct BlockMemory<F, M> {
    LookupsAhead lookups[2];  ///< of this block and of the next one
    GuidedDepartures<F, M> departures;
    GuidedRecords<M> records;

    BlockMemory(const M& method, const PathSettings& settings, SharedByThreads<M>& shared)
        : departures(method, settings), records(method, shared.locks) {}
};

}  // namespace pl
