// The shadow rays of a batch of paths, packed next to each other.
#pragma once

#include <vector>

#include "cpu/paths/batch_paths.h"
#include "cpu/paths/light_block.h"
#include "cpu/paths/vertex_block.h"

namespace pl {

/// The shadow rays of a batch of paths, whose contributions wait in the lanes of the paths.
template <FeatureSet F, Method M>
class Shadows {
public:
    explicit Shadows(Paths<F, M>& paths)
        : paths_(paths), rays_(paths.setup.batch_paths),
          lit_((paths.setup.batch_paths + kPathBlock - 1) / kPathBlock), kept_(kBlockGroups * lit_.size()),
          of_method_(Hookless<M> ? 0 : paths.setup.batch_paths) {
        Ray segment;
        segment.t_max = 1.0f;
        for (std::uint32_t i = 0; i < paths.setup.batch_paths; ++i) rays_.set_ray(i, segment);
    }

    void clear() { count_ = 0; }
    /// Appends the shadow rays of the block of path `first`, and tells the method of its light samples. `reached`: paths that have one.
    void pack(std::uint32_t first, const BlockRows& block, const VertexBlock<F, M>& vertices,
              const LightBlock<F, M>& lights, std::uint64_t reached) {
        BlockBits& lit = lit_[first / kPathBlock];
        lit.set(reached);
        const std::uint32_t before = count_;
        count_ = paths_.kernels.pack_shadow_rays(block, lights.groups(), lit, &kept_[first / kGroupSize],
                                                 rays_.ray_groups(), count_);
        if constexpr (F.has(Feature::EnvironmentMap) || F.has(Feature::DeltaLights)) set_lengths(before);
        if constexpr (!Hookless<M>) tell_method(first, vertices, lights, reached, before);
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
    /// Rays to far lights, from ray `begin` on, have no end.
    void set_lengths(std::uint32_t begin) {
        for (std::uint32_t ray = begin; ray < count_; ++ray) {
            RayGroup& group = rays_.ray_groups()[ray / kGroupSize];
            group.t_max[ray % kGroupSize] = group.target[ray % kGroupSize] == kNoPrimitive ? kInfinity : 1.0f;
        }
    }
    /// `reached`: the paths of the block of path `first` that have a light sample; `ray`: the number of its first shadow ray.
    void tell_method(std::uint32_t first, const VertexBlock<F, M>& vertices, const LightBlock<F, M>& lights,
                     std::uint64_t reached, std::uint32_t ray) {
        const std::uint64_t lit = lit_[first / kPathBlock].bits();
        for_bits(reached, [&](std::uint32_t k) {
            const bool wanted = ((lit >> k) & 1u) != 0;
            typename M::Memory none{};
            const typename M::Light light = paths_.method.light_sampled(
                memory_of(first + k, none), vertices.vertex(k),
                wanted ? lights.estimate(k, chain_weight(first + k, vertices.is_layered(k))) : LightEstimate{});
            if (wanted)
                of_method_[ray++] = light;
            else
                paths_.guided.record_light(light, false);
        });
    }
    /// The method's part of path i; hooks that are called in lanes have nothing there for light samples.
    typename M::Memory& memory_of([[maybe_unused]] std::uint32_t i, typename M::Memory& none) {
        if constexpr (kHooksInLanes<M>)
            return none;
        else
            return paths_.rows.beside(i).memory;
    }
    /// The weight of the specular chain that ends at a vertex; 1 where the light sample includes it, as at layered vertices.
    Vec3f chain_weight([[maybe_unused]] std::uint32_t i, [[maybe_unused]] bool is_layered) const {
        if constexpr (F.has_any(kLobeFeatures) && !kHooksInLanes<M>) {
            if (!is_layered) return paths_.rows.beside(i).chain.weight;
        }
        return Vec3f{1.0f};
    }
    /// Returns the paths in `lit` that see their lights. `ray`: index of their first shadow ray; leaves as the index of the next block's.
    std::uint64_t visible_of([[maybe_unused]] std::uint32_t first, std::uint64_t lit, std::uint32_t& ray) {
        std::uint64_t visible = 0;
        for_bits(lit, [&](std::uint32_t k) {
            const bool is_visible = !rays_.occluded(ray);
            visible |= std::uint64_t{is_visible} << k;
            if constexpr (!Hookless<M>) {
                typename M::Memory none{};
                if (is_visible) paths_.method.light_received(memory_of(first + k, none), paths_.counters.path.method);
                paths_.guided.record_light(of_method_[ray], is_visible);
            }
            ++ray;
        });
        return visible;
    }

    Paths<F, M>& paths_;
    RayBatch rays_;  ///< t_max is 1, except towards far lights
    std::uint32_t count_ = 0;
    std::vector<BlockBits> lit_;                ///< [block], the paths that have shadow rays
    std::vector<VectorGroup> kept_;             ///< [group], contributions
    std::vector<typename M::Light> of_method_;  ///< [shadow ray]; empty without hooks
};

}  // namespace pl
