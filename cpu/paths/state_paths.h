// The paths of a batch with a PathState each.
#pragma once

#include <new>
#include <vector>

#include "cpu/base/number_batch.h"
#include "cpu/paths/batch_paths.h"

namespace pl {

template <FeatureSet F, Method M>
class StatePaths : public BatchPaths<F, M> {
public:
    using State = PathState<F, M>;

    StatePaths(const PassSetup& arguments, const M& of, SharedByThreads<M>& shared)
        : BatchPaths<F, M>(arguments, of, shared), states_(arguments.batch_paths), rays_(arguments.batch_paths),
          numbers_(arguments.batch_paths, this->samples_lights()) {}

    /// Points of instances are made, and their volumes found, path by path.
    bool can_look_ahead() const { return !F.has(Feature::Instances) || this->setup.scene.instances.empty(); }

    RayBatch& rays() { return rays_; }
    NumberBatch& numbers() { return numbers_; }
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
        numbers_.set_path(i, states_[i]);
    }
    /// Path `from` continues in the place of path `to`.
    void move(std::uint32_t from, std::uint32_t to) {
        states_[to] = states_[from];
        send(to);
    }

private:
    std::vector<State> states_;
    RayBatch rays_;
    NumberBatch numbers_;
};

}  // namespace pl
