// The vertices of a block of paths, as structures of arrays: written once, and read in SIMD lanes while lights and directions are sampled.
// Paths in lanes have theirs in a LaneBlock, paths with a PathState each in a VertexBlock.
#pragma once

#include "core/kernel/integrator/steps.h"
#include "core/kernel/methods/method.h"
#include "cpu/base/groups.h"

namespace pl {

/// The vertices of a block, read one by one.
class VertexRows {
public:
    VertexGroup* groups() { return groups_; }
    const VertexGroup* groups() const { return groups_; }
    Vec3f albedo(std::uint32_t i) const { return group(i).albedo.get(i % kGroupSize); }
    std::uint32_t primitive(std::uint32_t i) const { return group(i).primitive[i % kGroupSize]; }
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

private:
    const VertexGroup& group(std::uint32_t i) const { return groups_[i / kGroupSize]; }

    VertexGroup groups_[kBlockGroups];
};

/// The vertices of a block in the lanes of their paths, all at Lambert reflectors. Vertex i is that of path i of the block, if it has
/// reached one from which it may go on.
template <Method M>
class LaneBlock : public VertexRows {
public:
    using Vertex = typename M::Vertex;

    /// The block has `count` paths; none is at a vertex.
    void clear(std::uint32_t count) {
        count_ = count;
        reached_ = 0;
        continuing_ = 0;
    }
    /// One bit per path that is at a vertex, and per path that goes on from there.
    void set_reached(std::uint64_t bits) { reached_ = bits; }
    void set_continuing(std::uint64_t bits) { continuing_ = bits; }
    void set_vertex(std::uint32_t i, const Vertex& vertex) { vertices_[i] = vertex; }

    std::uint32_t group_count() const { return pl::group_count(count_); }
    const Vertex& vertex(std::uint32_t i) const { return vertices_[i]; }
    static constexpr bool is_layered(std::uint32_t) { return false; }
    void for_lambert(const auto& visit) const { for_bits(reached_, visit); }
    void for_continuing_lambert(const auto& visit) const { for_bits(continuing_, visit); }

private:
    std::uint32_t count_ = 0;
    std::uint64_t reached_ = 0;
    std::uint64_t continuing_ = 0;
    Vertex vertices_[kPathBlock];
};

/// The vertices of a block at surfaces other than Lambert reflectors, whose directions are sampled path by path.
template <FeatureSet F, Method M>
struct LayeredVertices {
    std::uint64_t bits = 0;  ///< one per vertex of the block
    ScatterPoint<F, M> points[kPathBlock];
    ReceivedWeights weights[kPathBlock];  ///< before the roulette at the vertex
};
struct NoLayeredVertices {
    static constexpr std::uint64_t bits = 0;
};

/// At most kPathBlock vertices, numbered in the order of their paths: each is added when its path is shaded.
template <FeatureSet F, Method M>
class VertexBlock : public VertexRows {
public:
    using Vertex = typename M::Vertex;

    std::uint32_t count() const { return count_; }
    std::uint32_t group_count() const { return pl::group_count(count_); }
    void clear() {
        count_ = 0;
        continuing_ = 0;
        if constexpr (F.has_any(kLobeFeatures)) layered_.bits = 0;
    }

    /// The place of a vertex that add() may append next: a layered one stays there.
    ScatterPoint<F, M>& next_layered() requires(F.has_any(kLobeFeatures)) { return layered_.points[count_]; }
    /// Appends the vertex that a path has reached. `weights`: before the roulette there. A vertex at a surface other than a Lambert
    /// reflector must be in next_layered(); lanes know no more of it than its light sample needs.
    void add(std::uint32_t path, const ScatterPoint<F, M>& from, const ReceivedWeights& weights,
             const VertexUniforms& uniforms) {
        VertexGroup& group = groups()[count_ / kGroupSize];
        const std::uint32_t lane = count_ % kGroupSize;
        group.position.set(lane, from.surface.position);
        group.geometric_normal.set(lane, from.surface.geometric_normal);
        group.position_error[lane] = from.surface.position_error;
        group.primitive[lane] = from.surface.primitive;
        if constexpr (F.has(Feature::NextEventEstimation))
            for (int i = 0; i < 4; ++i) group.light.rows[i][lane] = uniforms.light[i];
        if (from.bsdf.is_lambert())
            add_lambert(group, lane, from, weights, uniforms);
        else if constexpr (F.has_any(kLobeFeatures))
            add_layered(from, weights);
        paths_[count_] = path;
        vertices_[count_++] = from.vertex;
    }
    /// The path of the last vertex continues from it.
    void keep_last(float roulette_weight) {
        const std::uint32_t last = count_ - 1;
        roulette_weights_[last] = roulette_weight;
        continuing_ |= std::uint64_t{1} << last;
    }

    std::uint32_t path(std::uint32_t i) const { return paths_[i]; }
    const Vertex& vertex(std::uint32_t i) const { return vertices_[i]; }
    float roulette_weight(std::uint32_t i) const { return roulette_weights_[i]; }
    std::uint32_t medium(std::uint32_t i) const requires(kTracksMedium<F>) { return media_.of[i]; }
    /// Whether vertex i is not at a Lambert reflector.
    bool is_layered(std::uint32_t i) const { return ((layered_.bits >> i) & 1u) != 0; }
    /// A vertex that is_layered().
    const ScatterPoint<F, M>& layered(std::uint32_t i) const requires(F.has_any(kLobeFeatures)) {
        return layered_.points[i];
    }
    const ReceivedWeights& layered_weights(std::uint32_t i) const requires(F.has_any(kLobeFeatures)) {
        return layered_.weights[i];
    }
    /// Calls visit(i) for every vertex at a Lambert reflector.
    void for_lambert(const auto& visit) const { for_bits(first_bits(count_) & ~layered_.bits, visit); }
    /// Calls visit(i) for every vertex whose path continues.
    void for_continuing(const auto& visit) const { for_bits(continuing_, visit); }
    /// Calls visit(i) for every vertex at a Lambert reflector whose path continues.
    void for_continuing_lambert(const auto& visit) const { for_bits(continuing_ & ~layered_.bits, visit); }

private:
    struct Media {
        std::uint32_t of[kPathBlock];
    };

    void add_lambert(VertexGroup& group, std::uint32_t lane, const ScatterPoint<F, M>& from,
                     const ReceivedWeights& weights, const VertexUniforms& uniforms) {
        group.shading_normal.set(lane, from.surface.shading_normal);
        group.albedo.set(lane, from.bsdf.albedo());
        group.scatter.set(lane, Vec3f{uniforms.scatter});
        if constexpr (F.has(Feature::NextEventEstimation)) group.throughput.set(lane, weights.throughput);
        if constexpr (kTracksMedium<F>) media_.of[count_] = weights.medium;
    }
    void add_layered([[maybe_unused]] const ScatterPoint<F, M>& from, const ReceivedWeights& weights) {
        PL_ASSERT(&from == &layered_.points[count_]);
        layered_.bits |= std::uint64_t{1} << count_;
        layered_.weights[count_] = weights;
    }

    static_assert(kPathBlock <= 64);
    std::uint32_t count_ = 0;
    std::uint64_t continuing_ = 0;  ///< one bit per vertex
    std::uint32_t paths_[kPathBlock];
    float roulette_weights_[kPathBlock];
    Vertex vertices_[kPathBlock];
    [[no_unique_address]] std::conditional_t<kTracksMedium<F>, Media, NoPathMedium> media_;
    [[no_unique_address]] std::conditional_t<F.has_any(kLobeFeatures), LayeredVertices<F, M>, NoLayeredVertices>
        layered_;
};

}  // namespace pl
