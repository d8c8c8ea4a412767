// The paths of a batch that stay in SIMD lanes.
#pragma once

#include <new>

#include "cpu/paths/batch_paths.h"
#include "cpu/paths/path_rows.h"

namespace pl {

template <FeatureSet F, Method M>
struct LanePaths : BatchPaths<F, M> {
    LanePaths(const PassSetup& arguments, const M& of, SharedByThreads<M>& shared)
        : BatchPaths<F, M>(arguments, of, shared), rows(arguments.batch_paths, this->samples_lights()) {}

    static constexpr bool can_look_ahead() { return true; }

    RayBatch& rays() { return rows.rays; }
    NumberBatch& numbers() { return rows.numbers; }
    /// Starts path i with the state that begin() returns. `store`: of path i, or null.
    PL_INLINE void start(std::uint32_t i, [[maybe_unused]] typename M::Store* store, const auto& begin) {
        if constexpr (PathRows<F, M>::kHooksInLanes) {
            rows.start(i, begin());
        } else {
            PathState<F, M>& state = rows.of_method(i);
            ::new (static_cast<void*>(&state)) PathState<F, M>(begin());  // as in StatePaths
            if (store != nullptr) keep_store(state, store);
            rows.start(i, state);
        }
    }
    /// The state of path i, which may be `local`.
    PathState<F, M>& read(std::uint32_t i, PathState<F, M>& local) { return rows.read(i, local); }
    /// Path `from` continues in the place of path `to`.
    void move(std::uint32_t from, std::uint32_t to) { rows.move(from, to); }

    PathRows<F, M> rows;
};

}  // namespace pl
