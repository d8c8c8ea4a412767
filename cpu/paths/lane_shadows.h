// The shadow rays of a batch of paths in SIMD lanes. Their contributions wait in the lanes of the paths.
#pragma once

#include <vector>

#include "cpu/paths/lane_block.h"
#include "cpu/paths/lane_paths.h"
#include "cpu/paths/light_block.h"

namespace pl {

template <FeatureSet F, Method M>
class LaneShadows {
public:
    explicit LaneShadows(LanePaths<F, M>& paths)
        : paths_(paths), rays_(paths.setup.batch_paths),
          lit_((paths.setup.batch_paths + kPathBlock - 1) / kPathBlock), kept_(kBlockGroups * lit_.size()),
          of_method_(Hookless<M> ? 0 : paths.setup.batch_paths) {
        Ray segment;
        segment.t_max = 1.0f;
        for (std::uint32_t i = 0; i < paths.setup.batch_paths; ++i) rays_.set_ray(i, segment);
    }

    void clear() { count_ = 0; }
    /// Appends the shadow rays of the block of path `first`, and tells the method of its light samples. `reached`: paths that have one.
    void pack(std::uint32_t first, const BlockRows& block, const LaneBlock<M>& vertices,
              const LightBlock<F, M>& lights, std::uint64_t reached) {
        BlockBits& lit = lit_[first / kPathBlock];
        lit.set(reached);
        const std::uint32_t before = count_;
        count_ = paths_.kernels.pack_shadow_rays(block, lights.groups(), lit, &kept_[first / kGroupSize],
                                                 rays_.ray_groups(), count_);
        if constexpr (!Hookless<M>) tell_method(first, vertices, lights, {reached, lit.bits(), before});
    }

    /// Adds the light samples of the first `active` paths that are not occluded. `hits`: SolidHits.
    [[gnu::flatten, gnu::noinline]] void connect(auto& hits, std::uint32_t active) {
        if (count_ == 0) return;
        hits.find_occluded(rays_, count_);
        std::uint32_t ray = 0;
        for (std::uint32_t first = 0; first < active; first += kPathBlock) {
            BlockBits& lit = lit_[first / kPathBlock];
            lit.set(visible_of(first, lit.bits(), ray));
            const std::uint32_t group = first / kGroupSize;
            paths_.kernels.connect_paths(&kept_[group], lit, paths_.rows.groups() + group,
                                         group_count(std::min(kPathBlock, active - first)));
        }
        paths_.counters.path.shadow_rays += count_;
    }

private:
    /// The light samples of a block: the paths that have one, and a shadow ray; the number of its first shadow ray.
    struct Requests {
        std::uint64_t reached, lit;
        std::uint32_t ray;
    };

    void tell_method(std::uint32_t first, const LaneBlock<M>& vertices, const LightBlock<F, M>& lights,
                     Requests requests) {
        for_bits(requests.reached, [&](std::uint32_t k) {
            const bool wanted = ((requests.lit >> k) & 1u) != 0;
            typename M::Memory none{};
            const typename M::Light light = paths_.method.light_sampled(
                PathRows<F, M>::kHooksInLanes ? none : paths_.rows.of_method(first + k).memory, vertices.vertex(k),
                wanted ? lights.estimate(k, Vec3f{1.0f}) : LightEstimate{});
            if (wanted)
                of_method_[requests.ray++] = light;
            else
                paths_.guided.record_light(light, false);
        });
    }
    /// Those of the paths in `lit` that see their lights. `ray`: number of their first shadow ray; leaves as that of the next block.
    std::uint64_t visible_of([[maybe_unused]] std::uint32_t first, std::uint64_t lit, std::uint32_t& ray) {
        std::uint64_t visible = 0;
        for_bits(lit, [&](std::uint32_t k) {
            const bool is_visible = !rays_.occluded(ray);
            visible |= std::uint64_t{is_visible} << k;
            if constexpr (!Hookless<M>) {
                if (is_visible && !PathRows<F, M>::kHooksInLanes)
                    paths_.method.light_received(paths_.rows.of_method(first + k).memory,
                                                 paths_.counters.path.method);
                paths_.guided.record_light(of_method_[ray], is_visible);
            }
            ++ray;
        });
        return visible;
    }

    LanePaths<F, M>& paths_;
    RayBatch rays_;  ///< segments: their t_max is 1
    std::uint32_t count_ = 0;
    std::vector<BlockBits> lit_;                ///< [block], the paths that have shadow rays
    std::vector<LitGroup> kept_;                ///< [group], contributions
    std::vector<typename M::Light> of_method_;  ///< [shadow ray]; empty without hooks
};
/// Lights are not sampled.
template <FeatureSet F, Method M>
requires(!F.has(Feature::NextEventEstimation)) class LaneShadows<F, M> {
public:
    explicit LaneShadows(LanePaths<F, M>&) {}
    void clear() {}
    void connect(auto&, std::uint32_t) {}
};

}  // namespace pl
