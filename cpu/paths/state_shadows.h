// The shadow rays of a batch of paths that have a PathState each.
#pragma once

#include <vector>

#include "core/kernel/integrator/steps.h"
#include "cpu/paths/state_paths.h"

namespace pl {

template <FeatureSet F, Method M>
class StateShadows {
public:
    explicit StateShadows(StatePaths<F, M>& paths)
        : paths_(paths), rays_(paths.setup.batch_paths), requests_(paths.setup.batch_paths),
          numbers_(paths.setup.batch_paths) {}

    void clear() { count_ = 0; }
    /// Appends a shadow ray of path i. The rest of the request is left to the caller.
    ShadowRequest<M>& add(std::uint32_t i, const Ray& ray) {
        rays_.set_ray(count_, ray);
        numbers_[count_] = i;
        return requests_[count_++];
    }

    /// Adds the light samples that are not occluded. `hits`: SolidHits.
    [[gnu::flatten, gnu::noinline]] void connect(auto& hits, std::uint32_t /*active*/) {
        hits.find_occluded(rays_, count_);
        for (std::uint32_t k = 0; k < count_; ++k) {
            const bool is_visible = !rays_.occluded(k);
            if (is_visible)
                connect_light(paths_.method, requests_[k], paths_.state(numbers_[k]), paths_.counters.path);
            paths_.guided.record_light(requests_[k].light, is_visible);
        }
        paths_.counters.path.shadow_rays += count_;
    }

private:
    StatePaths<F, M>& paths_;
    RayBatch rays_;
    std::vector<ShadowRequest<M>> requests_;  ///< [shadow ray]
    std::vector<std::uint32_t> numbers_;      ///< of their paths
    std::uint32_t count_ = 0;
};
/// Lights are not sampled.
template <FeatureSet F, Method M>
requires(!F.has(Feature::NextEventEstimation)) class StateShadows<F, M> {
public:
    explicit StateShadows(StatePaths<F, M>&) {}
    void clear() {}
    void connect(auto&, std::uint32_t) {}
};

}  // namespace pl
