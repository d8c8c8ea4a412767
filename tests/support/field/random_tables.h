// Tables in every state that learning and files can bring about, by chance, and their comparison to the bit.
#pragma once

#include <cstring>

#include "tests/support/field/field_fixture.h"

namespace pl::test {

inline bool same_tables(const HostTables& a, const HostTables& b) {
    bool same = true;
    zip(a, b, [&](const auto& left, const auto& right) {
        same = same && left.size() == right.size() &&
               std::memcmp(left.data(), right.data(), left.size() * sizeof(left[0])) == 0;
    });
    return same;
}

/// Many orders of magnitude, zero, the least and the largest floats, and values that only damaged memory holds.
inline float any_radiance(Uniforms& random) {
    constexpr float kSpecial[] = {0.0f, 1e-45f, 1e-38f, 1.0f, 3e38f, kInfinity, -1.0f};
    return random.below(8) == 0 ? kSpecial[random.below(7)] : std::exp2(random.between(-30.0f, 30.0f));
}

/// Small counts, counts beyond the mantissa of a float, and saturated ones.
inline std::uint32_t any_count(Uniforms& random) {
    const std::uint32_t bits = random.bits() >> random.below(32);
    return random.below(16) == 0 ? 0xffffffffu - random.below(3) : bits;
}

/// Up to 63 bits, so that all roundings to float occur.
inline std::int64_t any_sum(Uniforms& random) {
    const std::uint64_t bits = (std::uint64_t{random.bits()} << 32) | random.bits();
    return static_cast<std::int64_t>(bits >> (1 + random.below(60)));
}

/// Adds training samples to one cell in `gap`, and to the sums of the volume.
inline void add_any_samples(HostTables& tables, std::size_t volume, std::uint32_t gap, Uniforms& random) {
    const std::size_t cells = tables.radiance.size() / volume_count(tables);
    for (std::size_t cell = volume * cells; cell < (volume + 1) * cells; ++cell) {
        if (random.below(gap) != 0) continue;
        tables.pending_count[cell] = max_of(any_count(random), 1u);
        tables.pending_sum[cell] = any_sum(random);
    }
    tables.pending_slope[volume] = static_cast<std::int64_t>(random.bits()) - (std::int64_t{1} << 31);
    tables.pending_curvature[volume] = static_cast<std::int64_t>(random.bits());
    tables.pending_distance[volume] = static_cast<std::int64_t>(random.below(1000000));
    tables.pending_light[volume] = static_cast<std::int64_t>(random.bits());
    tables.pending_direct_count[volume] = max_of(any_count(random), 1u);
    tables.pending_direct[volume] = any_sum(random);
    const std::size_t clusters = tables.pending_cluster.size() / volume_count(tables);
    for (std::size_t i = volume * clusters; i < (volume + 1) * clusters; ++i)
        if (random.below(3) != 0) tables.pending_cluster[i] = any_sum(random);
}

/// Learned values of a volume, none in some cells; `wild`: with any_radiance().
inline void learn_anything(HostTables& tables, std::size_t volume, bool wild, Uniforms& random) {
    const std::size_t cells = tables.radiance.size() / volume_count(tables);
    for (std::size_t cell = volume * cells; cell < (volume + 1) * cells; ++cell) {
        if (random.below(4) == 0) continue;
        tables.radiance[cell] = wild ? any_radiance(random) : random.next();
        tables.visits[cell] = wild ? any_count(random) : random.below(5000);
        // Left over without a count: kept until a training sample comes.
        if (random.below(16) == 0) tables.pending_sum[cell] = any_sum(random);
    }
    tables.change[volume] = random.next();
    tables.mixture_target[volume] = random.next();
    tables.mixture_weight[volume] = random.next();
    tables.reach_distance[volume] = random.next();
    tables.reach_weight[volume] = random.next();
}

/// A field with empty, dark, common and wild volumes, with many, few and no new training samples.
inline TestField any_field(int side, std::size_t volumes, Uniforms& random) {
    TestField field(side, std::vector<Vec3f>(volumes, Vec3f{0, 0, 1}));
    field.shape.extent = 3.0f;
    for (std::size_t volume = 0; volume < volumes; ++volume) {
        const std::uint32_t state = random.below(4);
        if (state > 0) learn_anything(field.tables, volume, state == 1, random);
        const std::uint32_t samples = random.below(4);
        if (samples > 0) add_any_samples(field.tables, volume, samples * samples * samples, random);
    }
    return field;
}

}  // namespace pl::test
