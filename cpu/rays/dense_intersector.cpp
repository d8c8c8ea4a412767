#include "cpu/rays/dense_intersector.h"

#include <array>
#include <bit>

#include <fmt/format.h>

#include "core/base/error.h"

namespace pl {
namespace {

/// Bitwise equality: keeps 0 and -0 distinct, since merging them would save nothing.
bool same_bits(Vec3f a, Vec3f b) {
    using Bits = std::array<std::uint32_t, 3>;
    return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

}  // namespace

DenseIntersector::DenseIntersector(const SceneView& scene, const LaneKernels& kernels) : kernels_(kernels) {
    if (scene.direct_triangles() > kMaxDenseTriangles)
        throw Error(ErrorKind::Runtime, fmt::format("dense intersector: expected at most {} triangles, got {}",
                                                    kMaxDenseTriangles, scene.direct_triangles()));
    for (std::uint32_t i = 0; i < scene.direct_triangles(); ++i) {
        const Triangle& triangle = scene.triangles[i];
        const DenseTriangle dense{number_of(scene.positions[triangle.v0]), number_of(scene.positions[triangle.v1]),
                                  number_of(scene.positions[triangle.v2]), i};
        // With two coincident corners, edge functions are exactly opposite or zero: no ray passes the test.
        if (dense.a != dense.b && dense.b != dense.c && dense.c != dense.a) triangles_.push_back(dense);
    }
}

DenseView DenseIntersector::view() const {
    return {.positions = positions_.data(),
            .position_count = static_cast<std::uint32_t>(positions_.size()),
            .triangles = triangles_.data(),
            .triangle_count = static_cast<std::uint32_t>(triangles_.size())};
}

std::uint32_t DenseIntersector::number_of(Vec3f position) {
    for (std::uint32_t i = 0; i < positions_.size(); ++i)
        if (same_bits(positions_[i], position)) return i;
    positions_.push_back(position);
    return static_cast<std::uint32_t>(positions_.size() - 1);
}

}  // namespace pl
