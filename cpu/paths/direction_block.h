// Directions at the Lambert reflectors of a block, and the densities of directions towards lights, by the means that a method has: SIMD
// lanes for tables and for the BSDF, else path by path. Directions and densities of other vertices are arbitrary.
#pragma once

#include "core/kernel/integrator/probe.h"
#include "cpu/base/lane_kernels.h"
#include "cpu/learning/training_queue.h"

namespace pl {

/// Methods that sample directions at Lambert reflectors as DefaultMethod does.
template <class M>
concept LambertSampled = Method<M> &&(std::same_as<M, DefaultMethod> || std::same_as<M, ProbeMethod>);

/// One path after the other, by the functions of the method.
template <FeatureSet F, Method M>
class DirectionBlock {
public:
    explicit DirectionBlock(const M& method) : method_(method) {}

    /// Told that no vertex is in the block.
    void clear() {}
    /// Told of vertex i of the block, which is at a Lambert reflector.
    void add(std::uint32_t i, const SurfacePoint& surface, const typename M::Vertex& /*vertex*/,
             const ScatterUniforms& uniforms) {
        surfaces_[i] = surface;
        uniforms_[i] = uniforms;
    }
    /// Told that all vertices are added.
    void complete(const auto& /*block*/) {}
    /// Evaluates the densities of the method towards the lights of all vertices.
    void weigh_lights(const auto& block, const LightSampleGroup* lights) {
        block.for_lambert([&](std::uint32_t i) {
            const std::uint32_t lane = i % kGroupSize;
            const LightSampleGroup& group = lights[i / kGroupSize];
            if (!(group.pdf_sa[lane] > 0.0f)) return;
            directions_[i / kGroupSize].pdf_sa[lane] =
                method_.pdf_sa(block.vertex(i), surfaces_[i], group.wi.get(lane));
        });
    }
    /// Samples a direction at every Lambert reflector whose path continues.
    void sample(const auto& block) {
        block.for_continuing_lambert([&](std::uint32_t i) {
            directions_[i / kGroupSize].set(i % kGroupSize,
                                            method_.sample_direction(block.vertex(i), surfaces_[i], uniforms_[i]));
        });
    }
    const DirectionGroup* groups() const { return directions_; }

private:
    const M& method_;
    SurfacePoint surfaces_[kPathBlock];
    ScatterUniforms uniforms_[kPathBlock];
    DirectionGroup directions_[kBlockGroups];
};

template <FeatureSet F, LambertSampled M>
class DirectionBlock<F, M> {
public:
    explicit DirectionBlock(const M&) {}

    void clear() {}
    void add(std::uint32_t, const SurfacePoint&, const typename M::Vertex&, const ScatterUniforms&) {}
    void complete(const auto&) {}
    void weigh_lights(const auto& block, const LightSampleGroup* lights) {
        kernels_.weigh_lambert(block.groups(), lights, directions_, block.group_count());
    }
    void sample(const auto& block) { kernels_.sample_lambert(block.groups(), directions_, block.group_count()); }
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
    explicit DirectionBlock(const M& method) : method_(method) {}

    void clear() {
        for (GuidedGroup& group : groups_) std::fill_n(group.volume, kGroupSize, kNoVolume);
    }
    /// Prefetches the rows of the vertex's table.
    void add(std::uint32_t i, const SurfacePoint& surface, const TableLocation& vertex, const ScatterUniforms&) {
        if (!vertex.is_served()) return;
        const TableField& field = method_.field;
        __builtin_prefetch(field.row_cdf.data + vertex.volume * field.cells.side);
        groups_[i / kGroupSize].set_volume(i % kGroupSize, served_point(field, vertex, surface),
                                           method_.bsdf_fraction(vertex));
    }
    /// The volumes of the vertices, instead of calls of add().
    GuidedGroup* guided() { return groups_; }
    void complete(const auto& block) {
        for (std::uint32_t group = 0; group < block.group_count(); ++group)
            kernels_.sample_rows(sampler_of(method_.field), block.groups()[group], groups_[group], sampled_[group]);
    }
    void weigh_lights(const auto& block, const LightSampleGroup* lights) {
        kernels_.weigh_guided(sampler_of(method_.field), block.groups(), groups_, lights, directions_,
                              block.group_count());
    }
    void sample(const auto& block) {
        kernels_.sample_guided(sampler_of(method_.field), block.groups(), groups_, sampled_, directions_,
                               block.group_count());
    }
    const DirectionGroup* groups() const { return directions_; }

private:
    const M& method_;
    LaneKernels kernels_ = best_lane_kernels();
    GuidedGroup groups_[kBlockGroups];
    SampledGroup sampled_[kBlockGroups];
    DirectionGroup directions_[kBlockGroups];
};

}  // namespace pl
