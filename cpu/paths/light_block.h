// Light samples at the vertices of a block: lights are chosen in SIMD lanes, and sampled there at Lambert reflectors.
#pragma once

#include <array>
#include <vector>

#include "core/kernel/integrator/light_sample.h"
#include "cpu/paths/light_table.h"

namespace pl {

/// LearnedLights::cdf of all volumes of a method, one after the other; null: nothing is learned.
template <FeatureSet F, Method M>
const float* learned_cdf([[maybe_unused]] const M& method) {
    if constexpr (learns_lights<F, M>)
        return method.field.light_cdf.data;
    else
        return nullptr;
}

/// A light sample for every vertex of a block: bit-identical to sample_light() and weigh_light().
template <FeatureSet F, Method M>
class LightBlock {
public:
    /// `lights`: of the scene; without them lights are sampled path by path.
    LightBlock(const PathContext<M>& context, const LightTable* lights,
               const LaneKernels& kernels = best_lane_kernels())
        : context_(context), lights_(lights), kernels_(kernels) {}

    void sample(const auto& block) {
        if (lanes_pay()) sample_in_lanes(block);
        if (far_lights_are_in_lanes()) sample_far_in_lanes(block);
        block.for_lambert([&](std::uint32_t i) {
            if (is_triangle_in_lanes(block, i))
                look_up_emission(i);
            else if (!is_far_in_lanes(block, i))
                sample_lambert(block, i);
            if constexpr (kTracksMedium<F>) absorb(block, i);
        });
    }
    /// Weighs the samples at Lambert reflectors by multiple importance sampling. `directions`: densities of the method in their
    /// directions.
    void weigh(const auto& block, const DirectionGroup* directions) {
        kernels_.weigh_lights(block.groups(), directions, samples_, block.group_count());
    }

    const LightSampleGroup* groups() const { return samples_; }
    /// Whether a weighed sample contributes if nothing occludes the light.
    bool is_wanted(std::uint32_t i) const { return group(i).pdf_sa[i % kGroupSize] > 0.0f; }
    Vec3f contribution(std::uint32_t i) const { return group(i).contribution.get(i % kGroupSize); }
    /// `chain`: ReceivedWeights::chain.
    LightEstimate estimate(std::uint32_t i, Vec3f chain) const {
        const LightSampleGroup& from = group(i);
        const std::uint32_t lane = i % kGroupSize;
        LightEstimate estimate{(chain * from.reflected.get(lane)) * from.weight[lane], from.irradiance[lane]};
        if constexpr (F.has(Feature::ManyLights)) {
            if (!context_.scene.light_tree.empty()) estimate.cluster = from.cluster[lane];
        }
        return estimate;
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
    /// The light sample of a vertex that is layered.
    UnweightedLight sample_layered(const auto& block, std::uint32_t i, const ReceivedWeights& weights) const {
        const ScatterPoint<F, M>& from = block.layered(i);
        const bool is_in_lanes = is_triangle_in_lanes(block, i);
        const DirectLight sample =
            is_in_lanes ? reflected_alone(i, from) : sample_alone(block, i, from.surface, from.bsdf);
        if (!(sample.pdf_sa > 0.0f)) return {};
        const Ray ray = is_in_lanes ? shadow_ray(i, from.surface.primitive) : shadow_ray_to<F>(from.surface, sample);
        return unweighted_light(context_, from, sample, ray, weights);
    }
    /// Keeps the light sample of a vertex that is layered. `weight`: the MIS weight over its density.
    void set_layered(std::uint32_t i, const UnweightedLight& light, float weight) {
        LightSampleGroup& to = group(i);
        const std::uint32_t lane = i % kGroupSize;
        to.pdf_sa[lane] = light.pdf_sa;
        if (!(light.pdf_sa > 0.0f)) return;
        set_ray(i, light.ray);
        to.weight[lane] = weight;
        to.reflected.set(lane, light.reflected);
        to.contribution.set(lane, light.contribution * weight);
        to.irradiance[lane] = light.irradiance * weight;
        if constexpr (F.has(Feature::ManyLights)) to.cluster[lane] = light.cluster;
    }

private:
    /// Share of light samples of far lights above which most lanes would choose an emissive triangle in vain
    /// (docs/notebook/2026-11-27-light-tree-in-lanes.md).
    static constexpr float kMostFarSamples = 0.6f;

    LightSampleGroup& group(std::uint32_t i) { return samples_[i / kGroupSize]; }
    const LightSampleGroup& group(std::uint32_t i) const { return samples_[i / kGroupSize]; }

    /// Whether enough light samples are of emissive triangles for vectors to be worth their time.
    bool lanes_pay() const {
        if (lights_ == nullptr || lights_->empty()) return false;
        [[maybe_unused]] const SceneView& scene = context_.scene;
        if constexpr (F.has(Feature::EnvironmentMap)) {
            if (scene.far_probability > kMostFarSamples) return false;
        }
        if constexpr (F.has(Feature::DeltaLights)) {
            if (scene.delta_probability > 0.0f) return false;
        }
        return true;
    }
    void sample_in_lanes(const auto& block) {
        const LightRows lights = lights_->rows(context_.scene.light_power);
        if constexpr (F.has(Feature::ManyLights)) {
            const LightTree& tree = context_.scene.light_tree;
            if (!tree.empty()) {
                find_learned(block);
                kernels_.choose_by_tree(rows_of(tree, learned_cdf<F>(context_.method)), block.groups(), learned_,
                                        samples_, block.group_count());
                return kernels_.sample_chosen_lights(lights, block.groups(), samples_, block.group_count());
            }
        }
        kernels_.sample_lights(lights, block.groups(), samples_, block.group_count());
    }
    /// The choices of lights that were learned for the vertices.
    void find_learned([[maybe_unused]] const auto& block) {
        if constexpr (learns_lights<F, M>)
            block.for_reached([&](std::uint32_t i) {
                learned_[i / kGroupSize].set(i % kGroupSize, learned_lights<F>(context_.method, block.vertex(i)),
                                             learned_cdf<F>(context_.method));
            });
    }
    bool far_lights_are_in_lanes() const {
        [[maybe_unused]] const SceneView& scene = context_.scene;
        if constexpr (F.has(Feature::DeltaLights)) {
            if (scene.delta_probability > 0.0f) return false;
        }
        if constexpr (F.has(Feature::EnvironmentMap)) return scene.far_probability > 0.0f;
        return false;
    }
    void sample_far_in_lanes([[maybe_unused]] const auto& block) {
        if constexpr (F.has(Feature::EnvironmentMap)) {
            const SceneView& scene = context_.scene;
            kernels_.sample_far_lights({&scene.far_lights, scene.far_probability}, block.groups(), far_.data(),
                                       samples_, block.group_count());
        }
    }
    /// Whether the light sample of vertex i is a sample of the far lights that was made in lanes.
    bool is_far_in_lanes([[maybe_unused]] const auto& block, [[maybe_unused]] std::uint32_t i) const {
        if constexpr (F.has(Feature::EnvironmentMap))
            return far_lights_are_in_lanes() && block.light_uniforms(i).w < context_.scene.far_probability;
        return false;
    }
    /// Whether the light sample of vertex i is a sample of an emissive triangle that was made in lanes.
    bool is_triangle_in_lanes(const auto& block, std::uint32_t i) const {
        return lanes_pay() && !is_far_in_lanes(block, i);
    }
    template <class B>
    DirectLight sample_alone(const auto& block, std::uint32_t i, const SurfacePoint& surface, const B& bsdf) const {
        if constexpr (F.has(Feature::EnvironmentMap)) {
            if (is_far_in_lanes(block, i))
                return far_light_from(context_.scene, surface, bsdf, far_[i / kGroupSize].get(i % kGroupSize));
        }
        return sample_direct_light<F>(context_.scene, surface, bsdf, block.light_uniforms(i),
                                      learned_lights<F>(context_.method, block.vertex(i)));
    }
    void sample_lambert(const auto& block, std::uint32_t i) {
        const SurfacePoint surface = block.surface(i);
        const DirectLight sample = sample_alone(block, i, surface, LambertBsdf{block.albedo(i)});
        LightSampleGroup& to = group(i);
        const std::uint32_t lane = i % kGroupSize;
        to.pdf_sa[lane] = sample.pdf_sa;
        if (!(sample.pdf_sa > 0.0f)) return;
        set_ray(i, shadow_ray_to<F>(surface, sample));
        to.wi.set(lane, sample.wi);
        to.emitted.set(lane, sample.emitted);
        to.cos_i[lane] = sample.cos_i;
        if constexpr (F.has(Feature::ManyLights)) to.cluster[lane] = sample.cluster;
    }
    void set_ray(std::uint32_t i, const Ray& ray) {
        LightSampleGroup& to = group(i);
        const std::uint32_t lane = i % kGroupSize;
        to.target[lane] = ray.target;
        to.origin.set(lane, ray.origin);
        to.direction.set(lane, ray.direction);
    }
    /// The sample of an emissive triangle in lanes, at a vertex that is layered.
    DirectLight reflected_alone(std::uint32_t i, const ScatterPoint<F, M>& from) const {
        const LightSampleGroup& lights = group(i);
        const std::uint32_t lane = i % kGroupSize;
        DirectLight sample{.light = {}, .wi = lights.wi.get(lane)};
        if (!(lights.seen_pdf_sa[lane] > 0.0f)) return sample;
        sample.cos_i = from.bsdf.cosine(from.surface, sample.wi);
        if (!(sample.cos_i > 0.0f)) return sample;
        sample.emitted = emission(i);
        if (!is_black(sample.emitted)) sample.pdf_sa = lights.seen_pdf_sa[lane];
        if constexpr (F.has(Feature::ManyLights)) {
            if (!context_.scene.light_tree.empty()) sample.cluster = lights.cluster[lane];
        }
        return sample;
    }
    /// Emission of the emissive triangle that was sampled in lanes.
    Vec3f emission(std::uint32_t i) const {
        const LightSampleGroup& from = group(i);
        const std::uint32_t lane = i % kGroupSize;
        if constexpr (F.has(Feature::Textures) || F.has(Feature::CutOuts)) {
            SurfacePoint on_light;
            on_light.primitive = from.target[lane];
            on_light.material = context_.scene.triangles[on_light.primitive].material;
            on_light.front = from.is_behind[lane] == 0;
            return light_emitted<F>(context_.scene, on_light, from.weights.get(lane));
        }
        return from.emitted.get(lane);
    }
    /// Emission that varies over a light.
    void look_up_emission([[maybe_unused]] std::uint32_t i) {
        if constexpr (F.has(Feature::Textures) || F.has(Feature::CutOuts)) {
            if (group(i).pdf_sa[i % kGroupSize] > 0.0f) group(i).emitted.set(i % kGroupSize, emission(i));
        }
    }

    /// Absorption in the glass around a vertex.
    void absorb(const auto& block, std::uint32_t i) {
        if (context_.scene.absorption.empty() || block.medium(i) == kNoMedium || !is_wanted(i)) return;
        LightSampleGroup& to = group(i);
        const std::uint32_t lane = i % kGroupSize;
        const Ray ray = shadow_ray(i, block.primitive(i));
        to.emitted.set(lane, to.emitted.get(lane) * shadow_transmittance(context_.scene, block.medium(i), ray));
    }

    const PathContext<M>& context_;
    const LightTable* lights_;
    LaneKernels kernels_;
    LightSampleGroup samples_[kBlockGroups];
    LearnedLightsGroup learned_[kBlockGroups];
    [[no_unique_address]] MemberIf<F.has(Feature::EnvironmentMap), std::array<FarSampleGroup, kBlockGroups>> far_;
};

/// Lights of a tree that the paths of a batch have hit: the densities of light sampling there, found in SIMD lanes.
/// Bit-identical to light_pdf_area().
template <FeatureSet F, Method M>
class LightHits {
public:
    /// `lights`: of the scene; without them nothing is found.
    LightHits(const PathContext<M>& context, const LightTable* lights, std::uint32_t batch_paths)
        : context_(context), lights_(lights) {
        if (wanted()) pdf_area_.resize(batch_paths);
    }

    bool wanted() const {
        return lights_ != nullptr && context_.settings.next_event != 0 && !context_.scene.light_tree.empty();
    }
    /// For the hits of the first `count` paths of the batch `paths`, PathRows.
    void find(const auto& paths, std::uint32_t count) {
        count_ = 0;
        for (std::uint32_t path = 0; path < count; ++path)
            if (lights_->is_light(paths.rays.primitive(path)) && paths.direction_pdf_sa(path) > 0.0f)
                add(paths, path);
        kernels_.find_light_densities(rows_of(context_.scene.light_tree, learned_cdf<F>(context_.method)),
                                      hits_.data(), group_count(count_));
        for (std::uint32_t i = 0; i < count_; ++i)
            pdf_area_[paths_[i]] = hits_[i / kGroupSize].pdf_area[i % kGroupSize];
    }
    /// The density for a path that has hit a triangle after a vertex that sampled lights.
    float pdf_area(std::uint32_t path, std::uint32_t primitive) const {
        return lights_->is_light(primitive) ? pdf_area_[path] : 0.0f;
    }

private:
    void add(const auto& paths, std::uint32_t path) {
        if (count_ == paths_.size()) {
            paths_.resize(count_ + kGroupSize);
            hits_.emplace_back();
        }
        LightHitGroup& group = hits_[count_ / kGroupSize];
        const std::uint32_t lane = count_ % kGroupSize;
        group.from.set(lane, paths.rays.ray(path).origin);
        group.light[lane] = lights_->light_of(paths.rays.primitive(path));
        group.learned.set(lane, paths.learned_lights(path), learned_cdf<F>(context_.method));
        paths_[count_++] = path;
    }

    const PathContext<M>& context_;
    const LightTable* lights_;
    LaneKernels kernels_ = best_lane_kernels();
    std::vector<LightHitGroup> hits_;
    std::vector<std::uint32_t> paths_;  ///< of the hits, as many as their groups have lanes
    std::uint32_t count_ = 0;
    std::vector<float> pdf_area_;  ///< [path]
};

}  // namespace pl
