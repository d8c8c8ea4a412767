// The main loop on the CPU: each thread advances a batch of paths, one stage at a time for all of them, so that the intersector always has
// full vectors. The radiance of a path depends only on its number; batch size, threads and chunks affect speed only.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "cpu/paths/vertices.h"
#include "cpu/rays/solid_hits.h"

namespace pl {

/// The batch of one thread, active paths first. Each stage is one function with all calls inlined, so that its
/// machine code does not depend on the other sets of features in the same translation unit.
template <FeatureSet F, Method M, BatchIntersector I, PathWork<F, M> W>
class PathBatch {
public:
    PathBatch(const PassSetup& setup, const I& intersector, const M& method, const W& work, VolumeLocks& locks)
        : work_(work), hits_(setup.scene, intersector, setup.batch_paths), paths_(setup, method, locks),
          stores_(kNeedsStore<M> ? setup.batch_paths : 0), ended_((setup.batch_paths + kPathBlock - 1) / kPathBlock) {
    }

    /// Traces paths until the source is empty and the last path has ended.
    PassCounters run(PathSource& source) {
        fill(source);
        while (active_ > 0) {
            hits_.find_closest(paths_.rows.rays, active_);
            paths_.rows.uniforms.draw(paths_.setup.path, active_);
            extend();
            if constexpr (kHasShadows) shadows_.connect(hits_, active_);
            retire(source);
        }
        paths_.guided.flush();
        return paths_.counters;
    }

private:
    static constexpr bool kHasShadows = F.has(Feature::NextEventEstimation);

    [[gnu::flatten, gnu::noinline]] void fill(PathSource& source) {
        while (active_ < paths_.setup.batch_paths && start(source, active_)) ++active_;
    }
    /// Starts the next path of the source as path i. Returns false if the source is empty.
    PL_INLINE bool start(PathSource& source, std::uint32_t i) {
        PathStart next;
        if (!source.next(next)) return false;
        // Paths move only when no further ones start: then the store in the place of a path that has moved is still its own.
        paths_.rows.start(i, stores_.empty() ? nullptr : &stores_[i], [&] { return work_.begin(next); });
        return true;
    }

    void extend() {
        if constexpr (kHasShadows) shadows_.clear();
        vertices_.begin(active_);
        const auto end_of = [this](std::uint32_t first) { return std::min(first + kPathBlock, active_); };
        const bool looks_ahead = TableGuided<M> && paths_.can_look_ahead();
        if (looks_ahead) begin_lookups(0, end_of(0));
        for (std::uint32_t first = 0; first < active_; first += kPathBlock) {
            const std::uint32_t next = end_of(first);
            if (looks_ahead) {
                if (next < active_) begin_lookups(next, end_of(next));
                finish_lookups(first);
            }
            ended_[first / kPathBlock] = vertices_.extend(first, next - first, shadows_);
        }
    }
    /// Begins the lookups of the block of paths [first, end).
    void begin_lookups([[maybe_unused]] std::uint32_t first, [[maybe_unused]] std::uint32_t end) {
        if constexpr (TableGuided<M>)
            paths_.lookups_of(first).begin(paths_.setup.scene, paths_.method.field, paths_.rows.rays, first, end);
    }
    void finish_lookups([[maybe_unused]] std::uint32_t first) {
        if constexpr (TableGuided<M>) paths_.lookups_of(first).finish(paths_.setup.scene, paths_.method.field);
    }

    /// Finishes ended paths and refills their places with new paths, or with the last paths of the batch.
    [[gnu::flatten, gnu::noinline]] void retire(PathSource& source) {
        for (std::uint32_t block = 0; block * kPathBlock < active_; ++block) {
            // Pixels of the film: the prefetch of begin() has brought them to the L2 cache only.
            for_bits(ended_[block],
                     [&](std::uint32_t k) { work_.prefetch(paths_.rows.uniforms.pixel(block * kPathBlock + k)); });
            while (ended_[block] != 0) {
                const std::uint32_t i =
                    block * kPathBlock + static_cast<std::uint32_t>(std::countr_zero(ended_[block]));
                ended_[block] &= ended_[block] - 1;
                finish(i);
                if (!start(source, i)) put_last_in(i);
            }
        }
    }
    void finish(std::uint32_t i) {
        PathState<F, M> local;
        PathState<F, M>& state = paths_.rows.read(i, local);
        paths_.method.finished(state.memory, paths_.counters.path.method);
        count_path(paths_.counters, state.radiance, work_.finish(state, paths_.counters));
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

    const W& work_;
    SolidHits<F, I> hits_;
    Paths<F, M> paths_;
    std::vector<typename M::Store> stores_;  ///< empty if paths need none
    std::vector<std::uint64_t> ended_;       ///< [block], one bit per path
    Vertices<F, M> vertices_{paths_};
    [[no_unique_address]] MemberIf<kHasShadows, Shadows<F, M>> shadows_{paths_};
    std::uint32_t active_ = 0;
};

/// Traces the paths of `work` on setup.threads threads.
template <FeatureSet F, Method M, BatchIntersector I, PathWork<F, M> W>
PassCounters run_paths(const PassSetup& setup, const I& intersector, const M& method, const W& work) {
    ChunkQueue queue = setup.chunks(work.count());
    VolumeLocks locks(guiding_volumes(method));
    std::vector<PassCounters> counters(static_cast<std::size_t>(setup.threads));
    run_on_threads(setup.threads, [&](int thread) {
        PathSource source(queue, work.start_key(setup.path));
        PathBatch<F, M, I, W> batch(setup, intersector, method, work, locks);
        counters[static_cast<std::size_t>(thread)] = batch.run(source);
    });
    PassCounters total;
    for (const PassCounters& one : counters) total += one;
    return total;
}

}  // namespace pl
