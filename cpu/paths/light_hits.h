// Lights of a tree that the paths of a batch have hit: the densities of light sampling there, found in SIMD lanes.
#pragma once

#include <vector>

#include "cpu/paths/light_block.h"

namespace pl {

/// Bit-identical to light_pdf_area().
template <FeatureSet F, Method M>
class LightHits {
public:
    /// `lights`: of the scene; without them nothing is found.
    LightHits(const PathContext<M>& context, const LightTable* lights, std::uint32_t batch_paths)
        : context_(context), lights_(lights), learned_(context.method) {
        if (wanted()) pdf_area_.resize(batch_paths);
    }

    bool wanted() const {
        return lights_ != nullptr && context_.settings.next_event != 0 && !context_.scene.light_tree.empty();
    }
    /// For the hits of the first `count` paths. `state_of`: the PathState of a path, by its number.
    void find(const RayBatch& rays, std::uint32_t count, const auto& state_of) {
        count_ = 0;
        for (std::uint32_t path = 0; path < count; ++path) {
            const std::uint32_t primitive = rays.primitive(path);
            if (!lights_->is_light(primitive)) continue;
            const PathState<F, M>& state = state_of(path);
            if (state.direction_pdf_sa > 0.0f) add(path, primitive, state);
        }
        kernels_.find_light_densities(rows_of(context_.scene.light_tree, learned_.numbers()), hits_.data(),
                                      group_count(count_));
        for (std::uint32_t i = 0; i < count_; ++i)
            pdf_area_[paths_[i]] = hits_[i / kGroupSize].pdf_area[i % kGroupSize];
    }
    /// Of a path that has hit a triangle after a vertex that sampled lights.
    float pdf_area(std::uint32_t path, std::uint32_t primitive) const {
        return lights_->is_light(primitive) ? pdf_area_[path] : 0.0f;
    }

private:
    void add(std::uint32_t path, std::uint32_t primitive, const PathState<F, M>& state) {
        if (count_ == paths_.size()) {
            paths_.resize(count_ + kGroupSize);
            hits_.emplace_back();
        }
        LightHitGroup& group = hits_[count_ / kGroupSize];
        const std::uint32_t lane = count_ % kGroupSize;
        group.from.set(lane, state.ray.origin);
        group.light[lane] = lights_->light_of(primitive);
        group.learned.set(lane, state.lights.learned(), learned_.numbers());
        paths_[count_++] = path;
    }

    const PathContext<M>& context_;
    const LightTable* lights_;
    LaneKernels kernels_ = best_lane_kernels();
    LearnedLightsBlock<F, M> learned_;
    std::vector<LightHitGroup> hits_;
    std::vector<std::uint32_t> paths_;  ///< of the hits, as many as their groups have lanes
    std::uint32_t count_ = 0;
    std::vector<float> pdf_area_;  ///< [path]
};
template <FeatureSet F, Method M>
requires(!F.has(Feature::ManyLights)) class LightHits<F, M> {
public:
    LightHits(const PathContext<M>&, const LightTable*, std::uint32_t) {}
};

}  // namespace pl
