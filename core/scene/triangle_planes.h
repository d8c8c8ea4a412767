// The planes of a scene's triangles. Header only, because tests that compile a modified kernel pack a scene of their own.
#pragma once

#include <algorithm>
#include <vector>

#include "core/base/parallel.h"
#include "core/kernel/scene/triangle_plane.h"

namespace pl {

inline double longest_edge(Span<const Vec3f> positions, Span<const Triangle> triangles, int threads = 1) {
    const auto extend = [&](double& edge, IndexRange range) {
        for (std::uint32_t i = range.begin; i < range.end; ++i)
            edge = std::max(edge, TriangleCorners(positions, triangles[i]).longest_edge());
    };
    double longest = 0.0;
    for (const double edge : sums_of_chunks(triangles.count, kElementChunk, threads, 0.0, extend))
        longest = std::max(longest, edge);
    return longest;
}

/// `scene_edge`: see make_triangle_plane().
inline std::vector<TrianglePlane> make_triangle_planes(Span<const Vec3f> positions, Span<const Triangle> triangles,
                                                       double scene_edge, int threads = 1) {
    std::vector<TrianglePlane> planes(triangles.count);
    for_indices(triangles.count, threads, [&](std::uint32_t i) {
        planes[i] = make_triangle_plane({positions, triangles[i]}, scene_edge);
    });
    return planes;
}

}  // namespace pl
