// Vertices of a block as lanes leave them, for tests of what follows.
#pragma once

#include "cpu/paths/vertex_block.h"

namespace pl::test {

/// Puts a vertex of path i into its lane, with its random numbers. `throughput`: of the path there.
template <FeatureSet F, class M>
void put_vertex(VertexBlock<F, M>& block, std::uint32_t i, const ScatterPoint<F, M>& from,
                const VertexUniforms& uniforms, Vec3f throughput = Vec3f{1.0f}) {
    VertexGroup& group = block.groups()[i / kGroupSize];
    const std::uint32_t lane = i % kGroupSize;
    group.position.set(lane, from.surface.position);
    group.geometric_normal.set(lane, from.surface.geometric_normal);
    group.shading_normal.set(lane, from.surface.shading_normal);
    group.position_error[lane] = from.surface.position_error;
    group.primitive[lane] = from.surface.primitive;
    group.albedo.set(lane, from.bsdf.albedo());
    group.throughput.set(lane, throughput);
    group.scatter.set(lane, Vec3f{uniforms.scatter});
    for (int row = 0; row < 4; ++row) group.light.rows[row][lane] = uniforms.light[row];
    block.set_vertex(i, from.vertex);
    if constexpr (F.has_any(kLobeFeatures)) {
        if (from.bsdf.is_lambert()) return;
        block.set_layered(i, from.surface, from.bsdf);
        block.layered(i).vertex = from.vertex;
    }
}

}  // namespace pl::test
