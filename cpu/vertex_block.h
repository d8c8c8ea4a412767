// The vertices of a block of paths at Lambert reflectors, as structures of arrays: written once, when a path is shaded, and read in
// SIMD lanes while lights and directions are sampled.
#pragma once

#include <bit>

#include "core/kernel/integrator/steps.h"
#include "cpu/lane_kernels.h"

namespace pl {

/// At most kPathBlock vertices, numbered in the order of their paths.
template <FeatureSet F, Method M>
class VertexBlock {
public:
    using Vertex = typename M::Vertex;

    std::uint32_t count() const { return count_; }
    std::uint32_t group_count() const { return pl::group_count(count_); }
    void clear() {
        count_ = 0;
        continuing_ = 0;
    }

    /// Appends the vertex that a path has reached.
    /// `medium`: of the path there.
    void add(std::uint32_t path, const ScatterPoint<F, M>& from, Vec3f throughput, const VertexNumbers& numbers,
             [[maybe_unused]] std::uint32_t medium = kNoMedium) {
        VertexGroup& group = groups_[count_ / kGroupSize];
        const std::uint32_t lane = count_ % kGroupSize;
        group.position.set(lane, from.surface.position);
        group.geometric_normal.set(lane, from.surface.geometric_normal);
        group.shading_normal.set(lane, from.surface.shading_normal);
        group.position_error[lane] = from.surface.position_error;
        group.primitive[lane] = from.surface.primitive;
        group.albedo.set(lane, from.bsdf.albedo());
        group.scatter.set(lane, Vec3f{numbers.scatter});
        if constexpr (F.has(Feature::NextEventEstimation)) {
            group.throughput.set(lane, throughput);
            for (int i = 0; i < 4; ++i) group.light.rows[i][lane] = numbers.light[i];
        }
        if constexpr (kTracksMedium<F>) media_.of[count_] = medium;
        paths_[count_] = path;
        vertices_[count_++] = from.vertex;
    }
    /// The path of the last vertex continues from it.
    void keep_last(float roulette_weight) {
        roulette_weights_[count_ - 1] = roulette_weight;
        continuing_ |= std::uint64_t{1} << (count_ - 1);
    }

    const VertexGroup* groups() const { return groups_; }
    std::uint32_t path(std::uint32_t i) const { return paths_[i]; }
    const Vertex& vertex(std::uint32_t i) const { return vertices_[i]; }
    float roulette_weight(std::uint32_t i) const { return roulette_weights_[i]; }
    std::uint32_t medium(std::uint32_t i) const requires(kTracksMedium<F>) { return media_.of[i]; }
    Vec3f albedo(std::uint32_t i) const { return group(i).albedo.get(i % kGroupSize); }
    std::uint32_t primitive(std::uint32_t i) const { return group(i).primitive[i % kGroupSize]; }
    Vec4f light_numbers(std::uint32_t i) const { return group(i).light.get(i % kGroupSize); }
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
    /// Calls visit(i) for every vertex whose path continues.
    void for_continuing(const auto& visit) const {
        for (std::uint64_t rest = continuing_; rest != 0; rest &= rest - 1)
            visit(static_cast<std::uint32_t>(std::countr_zero(rest)));
    }

private:
    struct Media {
        std::uint32_t of[kPathBlock];
    };

    const VertexGroup& group(std::uint32_t i) const { return groups_[i / kGroupSize]; }

    static_assert(kPathBlock <= 64);
    std::uint32_t count_ = 0;
    std::uint64_t continuing_ = 0;  ///< one bit per vertex
    std::uint32_t paths_[kPathBlock];
    float roulette_weights_[kPathBlock];
    Vertex vertices_[kPathBlock];
    VertexGroup groups_[kBlockGroups];
    [[no_unique_address]] std::conditional_t<kTracksMedium<F>, Media, NoPathMedium> media_;
};

}  // namespace pl
