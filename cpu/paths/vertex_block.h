// The vertices of a block of paths, as structures of arrays in the lanes of their paths: written once, and read in SIMD lanes while lights
// and directions are sampled.
#pragma once

#include <array>

#include "core/kernel/integrator/steps.h"
#include "core/kernel/methods/method.h"
#include "cpu/base/groups.h"

namespace pl {

/// Vertex i belongs to path i of the block, if the path has reached a vertex from which it may go on.
template <FeatureSet F, Method M>
class VertexBlock {
public:
    using Vertex = typename M::Vertex;
    static constexpr bool kHasLobes = F.has_any(kLobeFeatures);

    /// The block has `count` paths; none is at a vertex.
    void clear(std::uint32_t count) {
        count_ = count;
        reached_ = 0;
        continuing_ = 0;
        if constexpr (kHasLobes) layered_bits_ = 0;
    }
    /// One bit per path that is at a vertex, and per path that goes on from there.
    void set_reached(std::uint64_t bits) { reached_ = bits; }
    void set_continuing(std::uint64_t bits) { continuing_ = bits; }
    void set_vertex(std::uint32_t i, const Vertex& vertex) { vertices_[i] = vertex; }
    void set_medium(std::uint32_t i, std::uint32_t medium) requires(kTracksMedium<F>) { media_[i] = medium; }
    /// Path i is at a surface other than a Lambert reflector. Rows know its normals, and its albedo for all directions together.
    void set_layered(std::uint32_t i, const SurfacePoint& surface, const Bsdf<F>& bsdf) requires(kHasLobes) {
        layered_bits_ |= std::uint64_t{1} << i;
        layered_[i].surface = surface;
        layered_[i].bsdf = bsdf;
    }

    std::uint32_t group_count() const { return pl::group_count(count_); }
    const Vertex& vertex(std::uint32_t i) const { return vertices_[i]; }
    std::uint32_t medium(std::uint32_t i) const requires(kTracksMedium<F>) { return media_[i]; }
    /// The vertices that are not at Lambert reflectors, and whether vertex i is one of them.
    std::uint64_t layered() const {
        if constexpr (kHasLobes)
            return layered_bits_;
        else
            return 0;
    }
    bool is_layered(std::uint32_t i) const { return ((layered() >> i) & 1u) != 0; }
    /// A vertex that is_layered().
    ScatterPoint<F, M>& layered(std::uint32_t i) requires(kHasLobes) { return layered_[i]; }
    const ScatterPoint<F, M>& layered(std::uint32_t i) const requires(kHasLobes) { return layered_[i]; }
    VertexGroup* groups() { return groups_; }
    const VertexGroup* groups() const { return groups_; }
    Vec3f albedo(std::uint32_t i) const { return group(i).albedo.get(i % kGroupSize); }
    std::uint32_t primitive(std::uint32_t i) const { return group(i).primitive[i % kGroupSize]; }
    Vec3f throughput(std::uint32_t i) const { return group(i).throughput.get(i % kGroupSize); }
    Vec4f light_uniforms(std::uint32_t i) const { return group(i).light.get(i % kGroupSize); }
    /// Without the material and the side.
    SurfacePoint surface(std::uint32_t i) const {
        const VertexGroup& from = group(i);
        const std::uint32_t lane = i % kGroupSize;
        return {.position = from.position.get(lane),
                .geometric_normal = from.geometric_normal.get(lane),
                .shading_normal = from.shading_normal.get(lane),
                .position_error = from.position_error[lane],
                .primitive = from.primitive[lane]};
    }

    /// With the material and the side, which are in `points`.
    SurfacePoint surface(std::uint32_t i, const PointGroup* points) const {
        SurfacePoint whole = surface(i);
        whole.material = points[i / kGroupSize].material[i % kGroupSize];
        whole.front = points[i / kGroupSize].front[i % kGroupSize] != 0;
        return whole;
    }
    void set_normal(std::uint32_t i, Vec3f normal) {
        groups_[i / kGroupSize].shading_normal.set(i % kGroupSize, normal);
    }
    void set_albedo(std::uint32_t i, Vec3f albedo) { groups_[i / kGroupSize].albedo.set(i % kGroupSize, albedo); }

    void for_reached(const auto& visit) const { for_bits(reached_, visit); }
    void for_lambert(const auto& visit) const { for_bits(reached_ & ~layered(), visit); }
    void for_continuing_lambert(const auto& visit) const { for_bits(continuing_ & ~layered(), visit); }

private:
    static_assert(kPathBlock <= 64);

    const VertexGroup& group(std::uint32_t i) const { return groups_[i / kGroupSize]; }

    VertexGroup groups_[kBlockGroups];
    std::uint32_t count_ = 0;
    std::uint64_t reached_ = 0;
    std::uint64_t continuing_ = 0;
    Vertex vertices_[kPathBlock];
    [[no_unique_address]] MemberIf<kTracksMedium<F>, std::array<std::uint32_t, kPathBlock>>
        media_;  ///< glass around them
    /// At surfaces other than Lambert reflectors, whose directions are sampled path by path; and one bit for each.
    [[no_unique_address]] MemberIf<kHasLobes, std::array<ScatterPoint<F, M>, kPathBlock>> layered_;
    [[no_unique_address]] MemberIf<kHasLobes, std::uint64_t> layered_bits_{};
};

}  // namespace pl
