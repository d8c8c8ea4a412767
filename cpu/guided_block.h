// Blocks of paths guided by tables: volumes are looked up before the paths reach their vertices, and directions at
// Lambert reflectors are sampled in SIMD lanes.
#pragma once

#include "core/kernel/integrator/steps.h"
#include "cpu/lane_kernels.h"
#include "cpu/lookups_ahead.h"
#include "cpu/training_queue.h"

namespace pl {

/// Dummy table, loaded by lanes without a volume if the field is empty.
inline constexpr float kOneCell[] = {1.0f};
inline constexpr TableSampler kNoTables{.cells = {1}, .row_cdf = kOneCell, .column_cdf = kOneCell};

inline TableSampler sampler_of(const TableField& field) {
    return field.normals.empty() ? kNoTables : field.sampler();
}

/// The volume of a vertex. Its position and normal come from the tree node of the lookup, if known: the node is in the cache.
inline ServedPoint<One> served_point(const TableField& field, const TableLocation& vertex,
                                     const SurfacePoint& surface) {
    ServedPoint<One> point = field.served_point(vertex, surface);
    if (vertex.node == FoundVolume::kUnknown) return point;
    const KdNode& node = field.tree.nodes[vertex.node];
    point.site = unpack(node.position);
    point.normal = unpack(node.normal);
    return point;
}

/// Sets the lane of a group to the vertex `from`, and prefetches the rows of its table.
template <FeatureSet F, TableGuided M>
void set_lane(const M& method, const ScatterPoint<F, M>& from, GuidedGroup& group, std::uint32_t lane) {
    const TableField& field = method.field;
    group.volume[lane] = kNoVolume;
    if (from.vertex.is_served()) {
        __builtin_prefetch(field.row_cdf.data + from.vertex.volume * field.cells.side);
        group.set_volume(lane, served_point(field, from.vertex, from.surface), method.bsdf_fraction(from.vertex));
    }
    group.position.set(lane, from.surface.position);
    group.shading_normal.set(lane, from.surface.shading_normal);
}

/// At most kGuidedBlock light samples at Lambert reflectors, whose densities by the method are evaluated at once: bit-identical to
/// M::pdf_sa(). Empty if lights are not sampled.
template <FeatureSet F, TableGuided M>
class LightBlock : public BlockPaths {
public:
    explicit LightBlock(const M& method) : method_(method) {}

    void add(std::uint32_t path, const ScatterPoint<F, M>& from, const UnweightedLight& light) {
        const std::uint32_t i = count();
        set_lane(method_, from, groups_[i / kGroupSize], i % kGroupSize);
        sampled_[i / kGroupSize].direction.set(i % kGroupSize, light.wi);
        vertices_[i] = from.vertex;
        lights_[i] = light;
        append(path);
    }
    void weigh_directions() {
        kernels_.weigh_guided(sampler_of(method_.field), groups_, sampled_, directions_, group_count(count()));
    }

    const typename M::Vertex& vertex(std::uint32_t i) const { return vertices_[i]; }
    const UnweightedLight& light(std::uint32_t i) const { return lights_[i]; }
    float pdf_sa(std::uint32_t i) const { return directions_[i / kGroupSize].pdf_sa[i % kGroupSize]; }

private:
    const M& method_;
    LaneKernels kernels_ = best_lane_kernels();
    typename M::Vertex vertices_[kGuidedBlock];
    UnweightedLight lights_[kGuidedBlock];
    GuidedGroup groups_[kGuidedGroups];
    SampledGroup sampled_[kGuidedGroups];
    DirectionGroup directions_[kGuidedGroups];
};
template <FeatureSet F, TableGuided M>
requires(!F.has(Feature::NextEventEstimation)) class LightBlock<F, M> {
public:
    explicit LightBlock(const M&) {}
};

/// At most kGuidedBlock paths at Lambert reflectors. Their directions are bit-identical to M::sample_direction().
template <FeatureSet F, TableGuided M>
class ScatterBlock : public BlockPaths {
public:
    explicit ScatterBlock(const M& method) : method_(method) {}

    /// Storage for the vertex of the next path; add() appends it.
    ScatterPoint<F, M>& next() { return points_[count()]; }
    void add(std::uint32_t path, Vec4f u) {
        const ScatterPoint<F, M>& from = points_[count()];
        GuidedGroup& group = groups_[count() / kGroupSize];
        const std::uint32_t lane = count() % kGroupSize;
        set_lane(method_, from, group, lane);
        group.choice[lane] = u.x;
        group.u_x[lane] = u.y;
        group.u_y[lane] = u.z;
        append(path);
        if (lane + 1 == kGroupSize) sample_rows();
    }

    void sample_directions() {
        if (count() % kGroupSize != 0) sample_rows();
        kernels_.sample_guided(sampler_of(method_.field), groups_, sampled_, directions_, group_count(count()));
    }

    const ScatterPoint<F, M>& point(std::uint32_t i) const { return points_[i]; }
    DirectionSample direction(std::uint32_t i) const { return directions_[i / kGroupSize].get(i % kGroupSize); }

private:
    /// Samples the table rows of the last group.
    void sample_rows() {
        const std::uint32_t group = (count() - 1) / kGroupSize;
        kernels_.sample_rows(sampler_of(method_.field), groups_[group], sampled_[group]);
    }
    const M& method_;
    LaneKernels kernels_ = best_lane_kernels();
    ScatterPoint<F, M> points_[kGuidedBlock];
    GuidedGroup groups_[kGuidedGroups];
    SampledGroup sampled_[kGuidedGroups];
    DirectionGroup directions_[kGuidedGroups];
};

/// State shared by the threads of a pass; empty for methods not guided by tables.
template <class M>
struct SharedByThreads {
    explicit SharedByThreads(const M&) {}
};
template <TableGuided M>
struct SharedByThreads<M> {
    VolumeLocks locks;

    explicit SharedByThreads(const M& method) : locks(method.field.normals.count) {}
};

/// Per-thread state for extending blocks of paths.
template <FeatureSet F, class M>
struct BlockMemory {
    BlockMemory(const M&, SharedByThreads<M>&) {}
};
template <FeatureSet F, TableGuided M>
struct BlockMemory<F, M> {
    LookupsAhead lookups[2];  ///< of the current and the next block
    ScatterBlock<F, M> scattered;
    [[no_unique_address]] LightBlock<F, M> lit;
    TrainingQueue<M, QueuedSample<M>> training;
    TrainingQueue<M, QueuedLight<M>> lights;

    BlockMemory(const M& method, SharedByThreads<M>& shared)
        : scattered(method), lit(method), training(method, shared.locks), lights(method, shared.locks) {}
};

}  // namespace pl
