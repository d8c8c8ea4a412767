// A small scene as the dense intersector reads it, and its loops, one pair per instruction set.
#pragma once

#include <cstdint>

#include "core/kernel/base/math.h"
#include "cpu/ray_batch.h"

namespace pl {

inline constexpr std::uint32_t kMaxDenseTriangles = 64;
inline constexpr std::uint32_t kMaxDensePositions = 3 * kMaxDenseTriangles;

struct DenseTriangle {
    std::uint32_t a, b, c;   ///< indices into DenseView::positions
    std::uint32_t primitive; ///< number in the scene
};

/// Plain pointers: the files that are compiled for wide vectors must not share a container's inline functions.
struct DenseView {
    const Vec3f* positions; ///< each once, however many triangles share it
    std::uint32_t position_count;
    const DenseTriangle* triangles; ///< in ascending order of their numbers
    std::uint32_t triangle_count;
};

/// All rays of `groups` groups against all triangles. Same bits from each.
struct DenseLoops {
    void (*find_closest)(const DenseView& scene, const RayGroup* rays, HitGroup* hits, std::uint32_t groups);
    void (*find_occluded)(const DenseView& scene,
                          const RayGroup* rays,
                          OcclusionMask* masks,
                          std::uint32_t groups);
};

extern const DenseLoops kDenseLoopsBaseline;
extern const DenseLoops kDenseLoopsAvx2;   ///< only in builds with PL_DENSE_CLONES
extern const DenseLoops kDenseLoopsAvx512; ///< only in builds with PL_DENSE_CLONES

} // namespace pl
