// The main loop on the CPU for scenes of Lambert reflectors: the batch of one thread, whose paths stay in SIMD lanes from step to step.
#pragma once

#include <cstdint>
#include <new>
#include <vector>

#include "cpu/lane_vertices.h"

namespace pl {

/// Active paths first. Each stage is one function with all calls inlined, as in PathBatch.
template <FeatureSet F, Method M, BatchIntersector I, PathWork<F, M> W>
class LanePathBatch {
public:
    LanePathBatch(const PassSetup& setup, const I& intersector, const M& method, const W& work,
                  SharedByThreads<M>& shared)
        : intersector_(intersector), work_(work), paths_(setup, method, shared),
          stores_(needs_store<M>(setup.path) ? setup.batch_paths : 0),
          ended_((setup.batch_paths + kPathBlock - 1) / kPathBlock) {}

    /// Traces paths until the source is empty and the last path has ended.
    PassCounters run(PathSource& source) {
        fill(source);
        while (active_ > 0) {
            intersector_.find_closest(paths_.rows.rays, active_);
            paths_.rows.numbers.draw(paths_.setup.path, active_);
            shadows_.clear();
            extend();
            shadows_.connect(intersector_, active_);
            retire(source);
        }
        paths_.guided.flush();
        return paths_.counters;
    }

private:
    [[gnu::flatten, gnu::noinline]] void fill(PathSource& source) {
        while (active_ < paths_.setup.batch_paths && start(source, active_)) ++active_;
    }
    /// Starts the next path of the source as path i. Returns false if the source is empty.
    PL_INLINE bool start(PathSource& source, std::uint32_t i) {
        PathStart next;
        if (!source.next(next)) return false;
        if (!paths_.rows.keeps_states()) {
            paths_.rows.start(i, work_.begin(next));
        } else if constexpr (!Hookless<M>) {
            PathState<F, M>& state = paths_.rows.of_method(i);
            ::new (static_cast<void*>(&state)) PathState<F, M>(work_.begin(next));  // as in PathBatch
            if (!stores_.empty()) keep_store(state, &stores_[i]);
            paths_.rows.start(i, state);
        }
        return true;
    }

    void extend() {
        const auto end_of = [this](std::uint32_t first) { return std::min(first + kPathBlock, active_); };
        if constexpr (TableGuided<M>) begin_lookups(0, 0, end_of(0));
        for (std::uint32_t first = 0; first < active_; first += kPathBlock) {
            const std::uint32_t next = end_of(first);
            if constexpr (TableGuided<M>) {
                begin_lookups(first + kPathBlock, next, end_of(next));
                paths_.lookups_of(first).finish(paths_.setup.scene, paths_.method.field);
            }
            ended_[first / kPathBlock] = vertices_.extend(first, next - first, shadows_);
        }
    }
    /// Begins the lookups of paths [begin, end) of the block of path `first`.
    void begin_lookups(std::uint32_t first, std::uint32_t begin, std::uint32_t end) {
        paths_.lookups_of(first).begin(paths_.setup.scene, paths_.method.field, paths_.rows.rays, begin, end);
    }

    /// Finishes ended paths and restarts their lanes with new paths, or with the last paths of the batch.
    [[gnu::flatten, gnu::noinline]] void retire(PathSource& source) {
        for (std::uint32_t block = 0; block * kPathBlock < active_; ++block) {
            while (ended_[block] != 0) {
                const std::uint32_t i =
                    block * kPathBlock + static_cast<std::uint32_t>(std::countr_zero(ended_[block]));
                ended_[block] &= ended_[block] - 1;
                if (!finish(i) && !start(source, i)) put_last_in(i);
            }
        }
    }
    /// Returns whether a branch of the path goes on in its place.
    bool finish(std::uint32_t i) {
        PathState<F, M> local;
        PathState<F, M>& state = paths_.rows.read(i, local);
        if (finish_branch(paths_.context, state, paths_.counters.path) == PathStatus::Continues) {
            paths_.rows.set(i, state);
            if constexpr (LaneLearning<M> && !std::is_empty_v<typename M::Sample>)
                paths_.rows.set_open_sample(i, state.memory);
            return true;
        }
        count_path(paths_.counters, state.radiance, work_.finish(state, paths_.counters));
        return false;
    }
    /// Path i, which has ended, leaves the batch: the last one, which may have ended as well, takes its place.
    void put_last_in(std::uint32_t i) {
        --active_;
        if (i == active_) return;
        const std::uint64_t last = std::uint64_t{1} << (active_ % kPathBlock);
        const bool has_ended = (ended_[active_ / kPathBlock] & last) != 0;
        ended_[active_ / kPathBlock] &= ~last;
        ended_[i / kPathBlock] |= std::uint64_t{has_ended} << (i % kPathBlock);
        paths_.rows.move(active_, i);
    }

    const I& intersector_;
    const W& work_;
    LanePaths<F, M> paths_;
    std::vector<PathStore<M>> stores_;  ///< empty if paths need none
    std::vector<std::uint64_t> ended_;  ///< [block], one bit per path
    LaneVertices<F, M> vertices_{paths_};
    [[no_unique_address]] ShadowBatch<F, M> shadows_{paths_};
    std::uint32_t active_ = 0;
};

}  // namespace pl
