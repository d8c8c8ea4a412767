// Lookups and training samples of paths guided by tables, for vectors of paths. Included by one file per instruction set; see lanes.h.
// Bit-identical to the hooks of Guided and ExpectedSarsa.
#pragma once

#include "core/kernel/methods/targets/expected_sarsa.h"
#include "cpu/base/groups.h"
#include "cpu/lanes/group_rows.h"

namespace pl {
namespace {

class TableLanes : GroupRows {
public:
    PL_INLINE TableLanes(const LearningRows& rows, std::uint32_t group, std::uint32_t first)
        : GroupRows(first), block_(rows.block), group_(group), points_(rows.block.points[group]),
          vertices_(rows.block.vertices[group]), guided_(rows.guided[group]), values_(rows.values[group]),
          open_(rows.open[group]), served_(lanes_of(rows.served.groups[group])) {}

    /// The values of the volumes, and what directions there are sampled by, at vertices that may have a volume. Marks
    /// the vertices that have a volume, and among these the vertices whose volume has no known node.
    PL_INLINE void look_up(const VolumeRows& field, BlockBits& with_volume, BlockBits& unknown) const {
        const LaneInt served = served_ & (integers(points_.volume) >= 0);
        const LaneInt volume = select(served, integers(points_.volume), LaneInt{});
        const LaneInt number = integers(points_.node);
        const LaneInt is_unknown = number == static_cast<std::int32_t>(FoundVolume::kUnknown);
        const Words<KdNode> node(field.nodes, select(served & ~is_unknown, number, LaneInt{}));
        store(select(served, volume, Lanes::constant(kNoVolume)), guided_.volume);
        store(node.vector(offsetof(KdNode, position)), guided_.site);
        store(node.vector(offsetof(KdNode, normal)), guided_.volume_normal);
        store(Lanes::load(field.inverse_reach, volume), guided_.inverse_reach);
        store(field.bsdf_fraction == nullptr ? broadcast(field.fraction) : Lanes::load(field.bsdf_fraction, volume),
              guided_.bsdf_fraction);
        store(select(served, Lanes::load(field.mean_radiance, volume), LaneFloat{}), values_.value);
        store(select(served, Lanes::load(field.direct, volume), LaneFloat{}), values_.direct);
        for (std::int32_t row = 0; row < field.side; row += kFloatsPerLine)
            Lanes::prefetch(field.row_cdf + row, volume * field.side);
        mark(served, with_volume);
        mark(served & is_unknown, unknown);
    }

    /// Guided::estimate_contribution() in lanes. `reached`: vertices from which paths may go on.
    PL_INLINE void estimate(const BlockBits& reached, BlockFloats& estimates) const {
        const PathGroup& paths = block_.paths[group_];
        const Real3<Lanes> albedo = vector(vertices_.albedo);
        const LaneFloat survival = row(paths.survival) * max_component(albedo);
        const LaneFloat reflected = rms(product(vector(paths.throughput), albedo));
        const LaneFloat expected = reflected * row(values_.value);
        const LaneFloat old = row(open_.first);
        const LaneInt is_first = lanes_of(reached.groups[group_]) & served_ & (old == 0.0f);
        const LaneFloat first = select(is_first, expected + reflected * row(values_.direct), old);
        store(first, open_.first);
        store(select(served_, expected_share<Lanes>(expected, first, survival), survival), estimates.of + begin());
    }

    /// Targets of the training samples that the ends of segments complete, as ExpectedSarsa::observe(). `emitted`: rms() of the emission
    /// there, of which light samples have their share. Marks the samples, and the clamped samples.
    PL_INLINE void complete(bool is_indirect, float most, const BlockFloats& emitted, BlockFloats& targets,
                            BlockBits& samples, BlockBits& clamped) const {
        const Real3<Lanes> albedo = vector(vertices_.albedo);
        const LaneFloat direct = is_indirect ? row(values_.direct) : LaneFloat{};
        const LaneInt has_no_value = is_black(albedo);
        const LaneFloat with_value =
            expected_sarsa_target<Lanes>(row(emitted.of + begin()), rms(albedo), row(values_.value), direct);
        const LaneFloat target = select(has_no_value, row(emitted.of + begin()), with_value);
        const LaneInt is_sample = (integers(open_.volume) >= 0) & (has_no_value | served_);
        store(target, targets.of + begin());
        mark(is_sample, samples);
        mark(is_sample & (target > most), clamped);
    }

    /// Opens training samples for the directions of `lanes`, as FieldTrainer::open_sample().
    PL_INLINE void open(const DirectionGroup* of_block, const BlockBits& lanes) const {
        const DirectionGroup& directions = of_block[group_];
        const LaneInt cell = integers(directions.bin);
        const LaneInt scattered = lanes_of(lanes.groups[group_]);
        const LaneInt opened = select(served_ & (cell >= 0), integers(points_.volume), Lanes::constant(kNoVolume));
        const LaneFloat ratio = row(directions.bsdf_pdf_sa) / row(directions.pdf_sa);
        store(select(scattered, opened, integers(open_.volume)), open_.volume);
        store(select(scattered, cell, integers(open_.cell)), open_.cell);
        store(select(scattered, ratio, row(open_.bsdf_ratio)), open_.bsdf_ratio);
    }

private:
    static constexpr std::int32_t kFloatsPerLine = 16;

    PL_INLINE void mark(const LaneInt& lanes, BlockBits& bits) const {
        bits.groups[group_] = static_cast<std::uint16_t>(bits.groups[group_] | mask_bits(lanes) << first());
    }
    /// Index of the group's first path in its block.
    PL_INLINE std::uint32_t begin() const { return group_ * kGroupSize; }

    const BlockRows& block_;
    std::uint32_t group_;
    const PointGroup& points_;
    const VertexGroup& vertices_;
    GuidedGroup& guided_;
    ValueGroup& values_;
    OpenGroup& open_;
    LaneInt served_;
};

/// Calls step(lanes) for every vector of every group of a block.
template <class Step>
PL_INLINE void for_table_lanes(const LearningRows& rows, const Step& step) {
    for (std::uint32_t group = 0; group < rows.block.groups; ++group)
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth) step(TableLanes(rows, group, first));
}

BlockBits look_up_volumes(const VolumeRows& field, const LearningRows& rows, BlockBits& unknown) {
    BlockBits served{};
    for_table_lanes(rows, [&](const TableLanes& lanes) { lanes.look_up(field, served, unknown); });
    return served;
}

void estimate_contributions(const LearningRows& rows, const BlockBits& reached, BlockFloats& estimates) {
    for_table_lanes(rows, [&](const TableLanes& lanes) { lanes.estimate(reached, estimates); });
}

void complete_samples(const LearningRows& rows, bool is_indirect, float most, const BlockFloats& emitted,
                      BlockFloats& targets, BlockBits& samples, BlockBits& clamped) {
    for_table_lanes(rows, [&](const TableLanes& lanes) {
        lanes.complete(is_indirect, most, emitted, targets, samples, clamped);
    });
}

void open_samples(const LearningRows& rows, const DirectionGroup* directions, const BlockBits& scattered) {
    for_table_lanes(rows, [&](const TableLanes& lanes) { lanes.open(directions, scattered); });
}

}  // namespace
}  // namespace pl
