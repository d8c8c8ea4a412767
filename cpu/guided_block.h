// Paths of a guided method on their way from one segment to the next: what they have to leave where they stand, and the
// directions that are chosen for all of them at once.
#pragma once

#include <concepts>
#include <type_traits>

#include "core/kernel/integrator/steps.h"
#include "cpu/lane_kernels.h"

namespace pl {

template <class M>
concept GuidedMethod = std::derived_from<M, GuidedSampling>;

/// Paths that are extended together: few enough for the innermost cache.
inline constexpr std::uint32_t kGuidedBlock = 64;

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
        const std::int32_t volume = departure.vertex.volume;
        if (volume != kNoVolume) __builtin_prefetch(method_.field.row_cdf.data + volume * method_.field.cells.side);
        GuidedGroup& group = groups_[count_ / kGroupSize];
        const std::uint32_t lane = count_ % kGroupSize;
        group.volume[lane] = volume;
        group.position_x[lane] = departure.surface.position.x;
        group.position_y[lane] = departure.surface.position.y;
        group.position_z[lane] = departure.surface.position.z;
        group.normal_x[lane] = departure.surface.shading_normal.x;
        group.normal_y[lane] = departure.surface.shading_normal.y;
        group.normal_z[lane] = departure.surface.shading_normal.z;
        group.choice[lane] = u.x;
        group.u_x[lane] = u.y;
        group.u_y[lane] = u.z;
        group.counters.pixel[lane] = state.pixel;
        group.counters.sample[lane] = state.sample;
        group.counters.vertex[lane] = state.vertices;
        paths_[count_++] = path;
    }

    void choose_directions() {
        kernels_.sample_guided(method_.field.normals.empty() ? kNoTables : method_.mixture_view(),
                               {settings_.seed, settings_.stream, Purpose::CellJitter}, groups_, directions_,
                               group_count(count_));
    }

    std::uint32_t path(std::uint32_t i) const { return paths_[i]; }
    const Departure<F, M>& departure(std::uint32_t i) const { return departures_[i]; }
    DirectionSample direction(std::uint32_t i) const { return directions_[i / kGroupSize].get(i % kGroupSize); }

private:
    /// Something to load for paths that no volume serves, where there is none at all.
    static constexpr float kOneCell[] = {1.0f};
    static constexpr float kUp[] = {0.0f, 0.0f, 1.0f};
    static constexpr float kFarAway[] = {0.0f};
    static constexpr GuidedMixture kNoTables{.cells = {1},
                                             .row_cdf = kOneCell,
                                             .column_cdf = kOneCell,
                                             .normals = kUp,
                                             .sites = kUp,
                                             .inverse_reach = kFarAway};

    const M& method_;
    const PathSettings& settings_;
    LaneKernels kernels_ = best_lane_kernels();
    std::uint32_t count_ = 0;
    std::uint32_t paths_[kGuidedBlock];
    Departure<F, M> departures_[kGuidedBlock];
    GuidedGroup groups_[kGuidedBlock / kGroupSize];
    DirectionGroup directions_[kGuidedBlock / kGroupSize];
};

/// What the paths of one block learn, on its way into the tables: these are asked for when a record comes and changed
/// when they have arrived, because they are larger than the caches.
template <GuidedMethod M>
class GuidedRecords {
public:
    explicit GuidedRecords(const M& method) : method_(method) {}

    void push(const typename M::Record& record) {
        if constexpr (kLearns) {
            if (record.volume == kNoVolume) return;
            const FieldView& field = method_.field;
            const std::uint32_t cell = field.cell_index(record.volume, record.cell);
            __builtin_prefetch(field.pending_sum.data + cell, 1);
            __builtin_prefetch(field.pending_count.data + cell, 1);
            __builtin_prefetch(field.pending_slope.data + record.volume, 1);
            __builtin_prefetch(field.pending_curvature.data + record.volume, 1);
            __builtin_prefetch(field.pending_distance.data + record.volume, 1);
            __builtin_prefetch(field.pending_light.data + record.volume, 1);
            records_[count_++] = record;
        }
    }
    void commit() {
        if constexpr (kLearns) {
            for (std::uint32_t i = 0; i < count_; ++i) method_.commit(records_[i]);
            count_ = 0;
        }
    }

private:
    static constexpr bool kLearns = !std::is_empty_v<typename M::Record>;

    const M& method_;
    std::uint32_t count_ = 0;
    typename M::Record records_[kLearns ? kGuidedBlock : 1];
};

/// What a block of paths needs while it is extended; nothing for methods that are not guided.
template <FeatureSet F, class M>
struct BlockMemory {
    BlockMemory(const M&, const PathSettings&) {}
};
template <FeatureSet F, GuidedMethod M>
struct BlockMemory<F, M> {
    GuidedDepartures<F, M> departures;
    GuidedRecords<M> records;

    BlockMemory(const M& method, const PathSettings& settings) : departures(method, settings), records(method) {}
};

}  // namespace pl
