// The hooks of methods guided by tables, in SIMD lanes: lookups, contribution estimates and training samples of a block's paths. What
// remains path by path is to queue the samples.
#pragma once

#include "cpu/paths/batch_paths.h"
#include "cpu/paths/direction_block.h"
#include "cpu/paths/vertex_block.h"

namespace pl {

template <FeatureSet F, class M>
class TableLearning {
public:
    explicit TableLearning(Paths<F, M>& paths) : paths_(paths) {}

    /// Told of the block of path `first`, and of the volumes that its directions are sampled by.
    void begin(std::uint32_t first, const BlockRows& block, GuidedGroup* guided) {
        first_ = first;
        rows_ = {.block = block,
                 .served = {},
                 .guided = guided,
                 .values = values_,
                 .open = paths_.rows.open_groups() + first / kGroupSize};
        emitted_ = {};
    }
    /// Looks up the volumes at surfaces that reflect and are not specular: `located`. `reached`: vertices from which paths may go on.
    void look_up(std::uint64_t located, [[maybe_unused]] std::uint64_t reached, VertexBlock<F, M>& vertices) {
        locate(located, vertices);
        if constexpr (!std::is_empty_v<typename M::Light> || learns_lights<F, M> || kTellsChains<F, M>)
            for_bits(reached, [&](std::uint32_t k) { vertices.set_vertex(k, vertex(k)); });
    }
    /// Told of the emission at the end of the segment of path k.
    void add_emission(std::uint32_t k, const Observation& observation) {
        emitted_.of[k] = rms(observation.emitted) * (is_indirect() ? observation.direction_share : 1.0f);
    }
    /// Completes the training samples of the paths in `observed`, at the ends of their segments.
    void complete([[maybe_unused]] std::uint64_t observed) {
        if constexpr (!std::is_empty_v<typename M::Sample>) {
            BlockFloats targets;
            BlockBits samples, clamped;
            const float most = kMaxRecordedUnits * paths_.method.field.radiance_unit;
            paths_.kernels.complete_samples(rows_, is_indirect(), most, emitted_, targets, samples, clamped);
            const std::uint64_t completed = samples.bits() & observed;
            MethodCounters& counters = paths_.counters.path.method;
            counters.records += static_cast<std::uint64_t>(std::popcount(completed));
            counters.clamped_records += static_cast<std::uint64_t>(std::popcount(clamped.bits() & observed));
            for_bits(completed, [&](std::uint32_t k) {
                OpenSample<TableField> sample = paths_.rows.open_sample(first_ + k);
                sample.distance = rows_.block.hits[k / kGroupSize].t[k % kGroupSize];
                paths_.guided.record({sample, targets.of[k]});
            });
        }
    }
    /// Contribution estimates, one per path, at the vertices in `reached`.
    const float* estimate(std::uint64_t reached) {
        BlockBits at;
        at.set(reached);
        paths_.kernels.estimate_contributions(rows_, at, estimates_);
        return estimates_.of;
    }
    /// Opens training samples of the paths in `scattered`.
    void scattered(const DirectionGroup* directions, std::uint64_t scattered) {
        if constexpr (!std::is_empty_v<typename M::Sample>) {
            if (!paths_.method.trains) return;
            BlockBits lanes;
            lanes.set(scattered);
            paths_.kernels.open_samples(rows_, directions, lanes);
        }
    }

    /// The volume of the vertex of path k.
    TableLocation vertex(std::uint32_t k) const {
        const PointGroup& points = rows_.block.points[k / kGroupSize];
        const std::uint32_t lane = k % kGroupSize;
        const bool is_served = ((rows_.served.bits() >> k) & 1u) != 0;
        return is_served ? TableLocation{points.volume[lane], points.node[lane]} : TableLocation{};
    }

private:
    bool is_indirect() const {
        if constexpr (!std::is_empty_v<typename M::Sample>)
            return paths_.method.learning.light == LearnedLight::Indirect;
        return false;
    }
    void locate(std::uint64_t located, const VertexBlock<F, M>& vertices) {
        const TableField& field = paths_.method.field;
        const MixtureSettings& mixture = paths_.method.mixture;
        BlockBits unknown;
        if (!field.normals.empty()) {
            if constexpr (F.has(Feature::Blends) || F.has(Feature::Instances)) locate_singly(located, vertices);
            rows_.served.set(located);
            rows_.served = paths_.kernels.look_up_volumes(
                {.nodes = field.tree.nodes.data,
                 .mean_radiance = field.mean_radiance.data,
                 .direct = field.direct.data,
                 .inverse_reach = field.inverse_reach.data,
                 .bsdf_fraction = mixture.learned != 0 ? field.bsdf_fraction.data : nullptr,
                 .fraction = mixture.bsdf_fraction,
                 .row_cdf = field.row_cdf.data,
                 .side = field.cells.side},
                rows_, unknown);
        }
        for_bits(unknown.bits(), [&](std::uint32_t k) {
            rows_.guided[k / kGroupSize].set_volume(k % kGroupSize,
                                                    served_point(field, vertex(k), vertices.surface(k)),
                                                    paths_.method.bsdf_fraction(vertex(k)));
        });
        const std::uint64_t missed = located & ~rows_.served.bits();
        paths_.counters.path.method.lookups += static_cast<std::uint64_t>(std::popcount(located));
        paths_.counters.path.method.lookup_misses += static_cast<std::uint64_t>(std::popcount(missed));
    }
    /// Volumes that are not looked up ahead: of instances, and of materials that show others.
    void locate_singly(std::uint64_t located, const VertexBlock<F, M>& vertices) {
        if (paths_.can_look_ahead()) located &= ~paths_.lookups_of(first_).found();
        for_bits(located, [&](std::uint32_t k) {
            PointGroup& points = rows_.block.points[k / kGroupSize];
            const TableLocation at = paths_.method.field.locate(vertices.surface(k, rows_.block.points));
            points.volume[k % kGroupSize] = at.volume;
            points.node[k % kGroupSize] = at.node;
        });
    }

    Paths<F, M>& paths_;
    std::uint32_t first_ = 0;
    LearningRows rows_{};
    ValueGroup values_[kBlockGroups];
    BlockFloats emitted_{};  ///< rms() of emission at the ends of segments, without the share of light samples
    BlockFloats estimates_{};
};

}  // namespace pl
