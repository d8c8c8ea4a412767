// The paths of a batch in groups of 16, as structures of arrays, between the steps of the integrator: members as in PathState. Paths
// keep their lanes from vertex to vertex, so that each step reads and writes whole vectors.
#pragma once

#include <bit>

#include "core/kernel/integrator/steps.h"
#include "cpu/base/lane_groups.h"

namespace pl {

/// 16 paths, besides their rays and the counters of their random numbers.
struct alignas(64) PathGroup {
    VectorGroup throughput, radiance;
    float direction_pdf_sa[kGroupSize] = {}, survival[kGroupSize] = {};
    std::uint32_t vertices[kGroupSize] = {};
    VectorGroup weight;                      ///< f cos / pdf at the last vertex
    float roulette_weight[kGroupSize] = {};  ///< 1 / survival probability of the roulette there
};

/// Calls visit(i) for every bit i that is set.
inline void for_bits(std::uint64_t bits, const auto& visit) {
    for (; bits != 0; bits &= bits - 1) visit(static_cast<std::uint32_t>(std::countr_zero(bits)));
}
/// The lowest `count` bits, at most 64.
inline std::uint64_t first_bits(std::uint32_t count) {
    return count < 64 ? (std::uint64_t{1} << count) - 1 : ~std::uint64_t{0};
}

/// One bit per path of a block: lane i of group g is bit 16 g + i.
struct BlockBits {
    std::uint16_t groups[kBlockGroups] = {};

    std::uint64_t bits() const {
        std::uint64_t all = 0;
        for (std::uint32_t group = 0; group < kBlockGroups; ++group)
            all |= std::uint64_t{groups[group]} << (group * kGroupSize);
        return all;
    }
    void set(std::uint64_t bits) {
        for (std::uint32_t group = 0; group < kBlockGroups; ++group)
            groups[group] = static_cast<std::uint16_t>(bits >> (group * kGroupSize));
    }
};

/// The ends of the segments of a block's paths.
struct SegmentMarks {
    BlockBits hit;         ///< a surface
    BlockBits emits;       ///< which emits light towards the path, if it is one
    BlockBits scatters;    ///< and which reflects
    BlockBits is_deepest;  ///< the vertex is the last one that the settings allow
};

/// The surfaces of a scene of Lambert reflectors as plain pointers.
struct SurfaceRows {
    const Material* materials;
    const TrianglePlane* planes;
    const TriangleNormals*
        triangle_normals;  ///< [primitive], indices into `normals`; null: shading normals are the geometric ones
    const Vec3f* normals;
};

template <FeatureSet F>
SurfaceRows surface_rows(const SceneView& scene) {
    const bool is_smooth = F.has(Feature::SmoothNormals) && !scene.triangle_normals.empty();
    return {.materials = scene.materials.data,
            .planes = scene.planes.data,
            .triangle_normals = is_smooth ? scene.triangle_normals.data : nullptr,
            .normals = scene.normals.data};
}

/// Rows of a block of paths. Groups of arrays have one entry per group.
struct BlockRows {
    const HitGroup* hits;
    const PointGroup* points;  ///< at the hits
    const NumberGroup* scatter;
    const NumberGroup* light;  ///< null: lights are not sampled
    CounterGroup* counters;
    PathGroup* paths;
    VertexGroup* vertices;
    std::uint32_t groups;
};

/// Contributions of light samples to 16 paths.
struct alignas(64) LitGroup {
    VectorGroup contribution;
};

}  // namespace pl
