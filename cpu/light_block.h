// Light samples at the vertices of a block, taken in SIMD lanes where lights are few.
#pragma once

#include <bit>
#include <vector>

#include "cpu/vertex_block.h"

namespace pl {

/// The lights of a scene by columns; empty if they are chosen by a tree.
class LightTable {
public:
    explicit LightTable(const SceneView& scene) : count_(scene.light_tree.empty() ? scene.lights.count : 0) {
        numbers_.resize(std::size_t{LightColumns::kCount} * count_);
        for (std::uint32_t light = 0; light < count_; ++light) fill(scene, light);
    }
    bool empty() const { return count_ == 0; }
    LightColumns columns() const { return {numbers_.data(), count_}; }

private:
    void fill(const SceneView& scene, std::uint32_t light) {
        const std::uint32_t primitive = scene.lights[light].primitive;
        const Triangle& triangle = scene.triangles[primitive];
        const TrianglePlane& plane = scene.planes[primitive];
        set(LightColumns::kCorner0, light, scene.positions[triangle.v0]);
        set(LightColumns::kCorner1, light, scene.positions[triangle.v1]);
        set(LightColumns::kCorner2, light, scene.positions[triangle.v2]);
        set(LightColumns::kNormal, light, plane.normal);
        set(LightColumns::kPositionError, light, plane.position_error);
        set(LightColumns::kPdfArea, light, light_pdf_area(scene, scene.materials[triangle.material]));
        set(LightColumns::kCumulative, light, scene.lights[light].cumulative_probability);
        set(LightColumns::kEmission, light, emitted_radiance(scene.materials[triangle.material], true));
        set(LightColumns::kBackEmission, light, emitted_radiance(scene.materials[triangle.material], false));
        set(LightColumns::kPrimitive, light, std::bit_cast<float>(primitive));
    }
    void set(int column, std::uint32_t light, float number) {
        numbers_[static_cast<std::size_t>(column) * count_ + light] = number;
    }
    void set(int column, std::uint32_t light, Vec3f v) {
        for (int axis = 0; axis < 3; ++axis) set(column + axis, light, v[axis]);
    }

    std::uint32_t count_;
    std::vector<float> numbers_;
};

/// A light sample for every vertex of a block: bit-identical to sample_light() and weigh_light().
template <FeatureSet F, Method M>
class LightBlock {
public:
    explicit LightBlock(const PathContext<M>& context, const LaneKernels& kernels = best_lane_kernels())
        : context_(context), table_(context.scene), kernels_(kernels) {}

    void sample(const VertexBlock<F, M>& block) {
        if (!table_.empty()) kernels_.sample_lights(table_.columns(), block.groups(), samples_, block.group_count());
        for (std::uint32_t i = 0; i < block.count(); ++i) {
            if (!is_in_lanes(block, i))
                sample_alone(block, i);
            else if constexpr (F.has(Feature::Textures) || F.has(Feature::CutOuts))
                look_up_emission(i);
            if constexpr (kTracksMedium<F>) absorb(block, i);
        }
    }
    /// Weighs the samples by multiple importance sampling. `directions`: densities of the method in their directions.
    void weigh(const VertexBlock<F, M>& block, const DirectionGroup* directions) {
        kernels_.weigh_lights(block.groups(), directions, samples_, block.group_count());
    }

    const LightSampleGroup* groups() const { return samples_; }
    /// Of a weighed sample: whether it contributes if nothing occludes the light.
    bool is_wanted(std::uint32_t i) const { return group(i).pdf_sa[i % kGroupSize] > 0.0f; }
    Vec3f contribution(std::uint32_t i) const { return group(i).contribution.get(i % kGroupSize); }
    /// `chain`: ReceivedWeights::chain.
    LightEstimate estimate(std::uint32_t i, Vec3f chain) const {
        const LightSampleGroup& from = group(i);
        const std::uint32_t lane = i % kGroupSize;
        return {(chain * from.reflected.get(lane)) * from.weight[lane], from.irradiance[lane], clusters_.get(i)};
    }
    /// The shadow ray; `source`: the primitive of the vertex.
    Ray shadow_ray(std::uint32_t i, std::uint32_t source) const {
        const LightSampleGroup& from = group(i);
        const std::uint32_t lane = i % kGroupSize;
        return {.origin = from.origin.get(lane),
                .direction = from.direction.get(lane),
                .t_max = from.target[lane] == kNoPrimitive ? kInfinity : 1.0f,
                .source = source,
                .target = from.target[lane]};
    }

private:
    /// Clusters of the lights chosen; only a light tree has them.
    struct Clusters {
        std::uint32_t of[kPathBlock];
        std::uint32_t get(std::uint32_t i) const { return of[i]; }
        void set(std::uint32_t i, std::uint32_t cluster) { of[i] = cluster; }
    };
    struct NoClusters {
        std::uint32_t get(std::uint32_t) const { return kNoCluster; }
        void set(std::uint32_t, std::uint32_t) {}
    };

    LightSampleGroup& group(std::uint32_t i) { return samples_[i / kGroupSize]; }
    const LightSampleGroup& group(std::uint32_t i) const { return samples_[i / kGroupSize]; }

    /// Whether the sample of vertex i has come from the lanes.
    bool is_in_lanes([[maybe_unused]] const VertexBlock<F, M>& block, std::uint32_t i) {
        if (table_.empty() || group(i).is_near[i % kGroupSize] != 0) return false;
        if constexpr (F.has(Feature::EnvironmentMap)) {
            if (block.light_numbers(i).w < context_.scene.far_probability) return false;
        }
        if constexpr (F.has(Feature::DeltaLights)) {
            if (context_.scene.delta_probability > 0.0f) return false;
        }
        clusters_.set(i, kNoCluster);
        return true;
    }
    void sample_alone(const VertexBlock<F, M>& block, std::uint32_t i) {
        const SurfacePoint surface = block.surface(i);
        const DirectLight sample =
            sample_direct_light<F>(context_.scene, surface, LambertBsdf{block.albedo(i)}, block.light_numbers(i),
                                   learned_lights<F>(context_.method, block.vertex(i)).learned());
        LightSampleGroup& to = group(i);
        const std::uint32_t lane = i % kGroupSize;
        to.pdf_sa[lane] = sample.pdf_sa;
        if (!(sample.pdf_sa > 0.0f)) return;
        const Ray ray = shadow_ray_to<F>(surface, sample);
        to.wi.set(lane, sample.wi);
        to.emitted.set(lane, sample.emitted);
        to.cos_i[lane] = sample.cos_i;
        to.target[lane] = ray.target;
        to.origin.set(lane, ray.origin);
        to.direction.set(lane, ray.direction);
        clusters_.set(i, sample.cluster);
    }
    /// Emission that varies over a light.
    void look_up_emission(std::uint32_t i) {
        LightSampleGroup& to = group(i);
        const std::uint32_t lane = i % kGroupSize;
        if (!(to.pdf_sa[lane] > 0.0f)) return;
        SurfacePoint on_light;
        on_light.primitive = to.target[lane];
        on_light.material = context_.scene.triangles[on_light.primitive].material;
        on_light.front = to.is_behind[lane] == 0;
        to.emitted.set(lane, light_emitted<F>(context_.scene, on_light, to.weights.get(lane)));
    }

    /// Absorption in the glass around a vertex.
    void absorb(const VertexBlock<F, M>& block, std::uint32_t i) {
        if (context_.scene.absorption.empty() || block.medium(i) == kNoMedium || !is_wanted(i)) return;
        LightSampleGroup& to = group(i);
        const std::uint32_t lane = i % kGroupSize;
        const Ray ray = shadow_ray(i, block.primitive(i));
        to.emitted.set(lane, to.emitted.get(lane) * shadow_transmittance(context_.scene, block.medium(i), ray));
    }

    const PathContext<M>& context_;
    LightTable table_;
    LaneKernels kernels_;
    LightSampleGroup samples_[kBlockGroups];
    [[no_unique_address]] std::conditional_t<F.has(Feature::ManyLights), Clusters, NoClusters> clusters_;
};
template <FeatureSet F, Method M>
requires(!F.has(Feature::NextEventEstimation)) class LightBlock<F, M> {
public:
    explicit LightBlock(const PathContext<M>&) {}
};

}  // namespace pl
