// Directions at the Lambert reflectors of a block, and the densities of directions towards lights, by the means that a method has: SIMD
// lanes for tables and for the BSDF, else path by path. Those of its other vertices are arbitrary.
#pragma once

#include "core/kernel/integrator/probe.h"
#include "cpu/training_queue.h"
#include "cpu/vertex_block.h"

namespace pl {

/// Methods whose directions at Lambert reflectors are those of DefaultMethod.
template <class M>
concept LambertSampled = Method<M> &&(std::same_as<M, DefaultMethod> || std::same_as<M, ProbeMethod>);

/// One path after the other, by the functions of the method.
template <FeatureSet F, Method M>
class DirectionBlock {
public:
    DirectionBlock(const PathSettings& settings, const M& method) : settings_(settings), method_(method) {}

    /// Told of the last vertex of the block, which was `from`.
    void add(const VertexBlock<F, M>& block, const ScatterPoint<F, M>& from, Vec4f u) {
        surfaces_[block.count() - 1] = from.surface;
        numbers_[block.count() - 1] = u;
    }
    /// Told that all vertices are added.
    void complete(const VertexBlock<F, M>&) {}
    /// Evaluates the densities of the method towards the lights of all vertices.
    void weigh_lights(const VertexBlock<F, M>& block, const LightSampleGroup* lights) {
        for (std::uint32_t i = 0; i < block.count(); ++i) {
            const std::uint32_t lane = i % kGroupSize;
            const LightSampleGroup& group = lights[i / kGroupSize];
            if (block.is_layered(i) || !(group.pdf_sa[lane] > 0.0f)) continue;
            directions_[i / kGroupSize].pdf_sa[lane] =
                method_.pdf_sa(block.vertex(i), surfaces_[i], group.wi.get(lane));
        }
    }
    /// Samples a direction at every Lambert reflector whose path continues. `states`: of all paths of the batch.
    void sample(const VertexBlock<F, M>& block, const PathState<F, M>* states) {
        block.for_continuing_lambert([&](std::uint32_t i) {
            const PathState<F, M>& state = states[block.path(i)];
            const ScatterNumbers numbers = scatter_numbers(settings_, state, numbers_[i]);
            directions_[i / kGroupSize].set(i % kGroupSize,
                                            method_.sample_direction(block.vertex(i), surfaces_[i], numbers));
        });
    }
    const DirectionGroup* groups() const { return directions_; }

private:
    const PathSettings& settings_;
    const M& method_;
    SurfacePoint surfaces_[kPathBlock];
    Vec4f numbers_[kPathBlock];
    DirectionGroup directions_[kBlockGroups];
};

template <FeatureSet F, LambertSampled M>
class DirectionBlock<F, M> {
public:
    DirectionBlock(const PathSettings&, const M&) {}

    void add(const VertexBlock<F, M>&, const ScatterPoint<F, M>&, Vec4f) {}
    void complete(const VertexBlock<F, M>&) {}
    void weigh_lights(const VertexBlock<F, M>& block, const LightSampleGroup* lights) {
        kernels_.weigh_lambert(block.groups(), lights, directions_, block.group_count());
    }
    void sample(const VertexBlock<F, M>& block, const PathState<F, M>*) {
        kernels_.sample_lambert(block.groups(), directions_, block.group_count());
    }
    const DirectionGroup* groups() const { return directions_; }

private:
    LaneKernels kernels_ = best_lane_kernels();
    DirectionGroup directions_[kBlockGroups];
};

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

template <FeatureSet F, TableGuided M>
class DirectionBlock<F, M> {
public:
    DirectionBlock(const PathSettings&, const M& method) : method_(method) {}

    /// Prefetches the rows of the vertex's table.
    void add(const VertexBlock<F, M>& block, const ScatterPoint<F, M>& from, Vec4f) {
        const TableField& field = method_.field;
        const std::uint32_t last = block.count() - 1;
        GuidedGroup& group = groups_[last / kGroupSize];
        const std::uint32_t lane = last % kGroupSize;
        group.volume[lane] = kNoVolume;
        if (!block.is_layered(last) && from.vertex.is_served()) {
            __builtin_prefetch(field.row_cdf.data + from.vertex.volume * field.cells.side);
            group.set_volume(lane, served_point(field, from.vertex, from.surface),
                             method_.bsdf_fraction(from.vertex));
        }
        if (lane + 1 == kGroupSize) sample_rows(block, last / kGroupSize);
    }
    void complete(const VertexBlock<F, M>& block) {
        if (block.count() % kGroupSize != 0) sample_rows(block, block.count() / kGroupSize);
    }
    void weigh_lights(const VertexBlock<F, M>& block, const LightSampleGroup* lights) {
        kernels_.weigh_guided(sampler_of(method_.field), block.groups(), groups_, lights, directions_,
                              block.group_count());
    }
    void sample(const VertexBlock<F, M>& block, const PathState<F, M>*) {
        kernels_.sample_guided(sampler_of(method_.field), block.groups(), groups_, sampled_, directions_,
                               block.group_count());
    }
    const DirectionGroup* groups() const { return directions_; }

private:
    void sample_rows(const VertexBlock<F, M>& block, std::uint32_t group) {
        kernels_.sample_rows(sampler_of(method_.field), block.groups()[group], groups_[group], sampled_[group]);
    }

    const M& method_;
    LaneKernels kernels_ = best_lane_kernels();
    GuidedGroup groups_[kBlockGroups];
    SampledGroup sampled_[kBlockGroups];
    DirectionGroup directions_[kBlockGroups];
};

}  // namespace pl
