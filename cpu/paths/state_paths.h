// The paths of a batch with a PathState each, and their shadow rays.
#pragma once

#include <new>
#include <vector>

#include "core/kernel/integrator/steps.h"
#include "cpu/base/uniform_batch.h"
#include "cpu/paths/batch_paths.h"

namespace pl {

template <FeatureSet F, Method M>
class StatePaths : public BatchPaths<F, M> {
public:
    using State = PathState<F, M>;

    StatePaths(const PassSetup& arguments, const M& of, SharedByThreads<M>& shared)
        : BatchPaths<F, M>(arguments, of, shared), states_(arguments.batch_paths), rays_(arguments.batch_paths),
          uniforms_(arguments.batch_paths, this->samples_lights()) {}

    /// Points of instances are made, and their volumes found, path by path.
    bool can_look_ahead() const { return !F.has(Feature::Instances) || this->setup.scene.instances.empty(); }

    RayBatch& rays() { return rays_; }
    UniformBatch& uniforms() { return uniforms_; }
    State& state(std::uint32_t i) { return states_[i]; }

    /// Starts path i with the state that begin() returns. `store`: of path i, or null.
    PL_INLINE void start(std::uint32_t i, typename M::Store* store, const auto& begin) {
        // Constructed in place: the wide loads of a copy would stall, since narrower stores do not forward to them.
        ::new (static_cast<void*>(&states_[i])) State(begin());
        if (store != nullptr) keep_store(states_[i], store);
        send(i);
    }
    /// The state of path i.
    State& read(std::uint32_t i, State& /*local*/) { return states_[i]; }
    /// Copies the ray and the random-number counter of path i into the arrays of the batch.
    void send(std::uint32_t i) {
        rays_.set_ray(i, states_[i].ray);
        uniforms_.set_path(i, states_[i]);
    }
    /// Path `from` continues in the place of path `to`.
    void move(std::uint32_t from, std::uint32_t to) {
        states_[to] = states_[from];
        send(to);
    }

private:
    std::vector<State> states_;
    RayBatch rays_;
    UniformBatch uniforms_;
};

/// The shadow rays of these paths.
template <FeatureSet F, Method M>
class StateShadows {
public:
    explicit StateShadows(StatePaths<F, M>& paths)
        : paths_(paths), rays_(paths.setup.batch_paths), requests_(paths.setup.batch_paths),
          path_of_(paths.setup.batch_paths) {}

    void clear() { count_ = 0; }
    /// Appends a shadow ray of path i. The rest of the request is left to the caller.
    ShadowRequest<M>& add(std::uint32_t i, const Ray& ray) {
        rays_.set_ray(count_, ray);
        path_of_[count_] = i;
        return requests_[count_++];
    }

    /// Adds the light samples that are not occluded. `hits`: SolidHits.
    [[gnu::flatten, gnu::noinline]] void connect(auto& hits, std::uint32_t /*active*/) {
        hits.find_occluded(rays_, count_);
        for (std::uint32_t k = 0; k < count_; ++k) {
            const bool is_visible = !rays_.occluded(k);
            if (is_visible)
                connect_light(paths_.method, requests_[k], paths_.state(path_of_[k]), paths_.counters.path);
            paths_.guided.record_light(requests_[k].light, is_visible);
        }
        paths_.counters.path.shadow_rays += count_;
    }

private:
    StatePaths<F, M>& paths_;
    RayBatch rays_;
    std::vector<ShadowRequest<M>> requests_;  ///< [shadow ray]
    std::vector<std::uint32_t> path_of_;      ///< [shadow ray]
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
