// The main loop of this back end: each thread keeps a batch of paths under way and takes one step with all of them at
// a time, so that the intersector always has full vectors. What a path brings depends on nothing but its number;
// batch size, threads and chunks decide speed only.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <new>
#include <vector>

#include "core/kernel/integrator/steps.h"
#include "core/session/backend.h"
#include "cpu/guided_block.h"
#include "cpu/path_source.h"
#include "cpu/ray_batch.h"
#include "cpu/solid_hits.h"

namespace pl {

/// What every pass has in common.
struct PassSetup {
    SceneView scene;
    PathSettings path;
    IndexRange paths{0, kToTheLast};  ///< those to trace, as far as there are any
    const StopFlag* stop = nullptr;
    int threads = 1;
    std::uint32_t batch_paths = 1024;

    /// The paths to trace of `count` in all.
    ChunkQueue chunks(std::uint32_t count) const {
        return ChunkQueue(paths.begin, std::min(paths.end, count), kPathChunk, stop);
    }
};

/// Where paths start and end. Paths are numbered from 0; start_sample() is whose random numbers they start with; finish() says
/// whether the sample was valid.
template <class W, FeatureSet F, class M>
concept PathWork = requires(const W& work, std::uint32_t number, Vec4f u, const PathState<F, M>& state,
                            MethodCounters& counters) {
    { work.count() } -> std::same_as<std::uint32_t>;
    { work.start_sample() } -> std::same_as<std::uint32_t>;
    { work.begin(number, u) } -> std::same_as<PathState<F, M>>;
    { work.finish(state, counters) } -> std::same_as<bool>;
};

/// The paths of one thread, the live ones first. Its stages are functions of their own, inlined to the last call: what the
/// compiler makes of them hangs on nothing else that is compiled beside them, so that sets of effects cost each other nothing.
template <FeatureSet F, Method M, BatchIntersector I, PathWork<F, M> W>
class PathBatch {
public:
    PathBatch(const PassSetup& setup, const I& intersector, const M& method, const W& work,
              SharedByThreads<M>& shared)
        : setup_(setup), intersector_(intersector), method_(method), work_(work), states_(setup.batch_paths),
          statuses_(setup.batch_paths), numbers_(setup.batch_paths, kSamplesLights && setup.path.next_event != 0),
          rays_(setup.batch_paths), shadows_(kSamplesLights ? setup.batch_paths : 0), shadow_paths_(shadows_.size()),
          shadow_rays_(static_cast<std::uint32_t>(shadows_.size())),
          solid_hits_(setup.scene, intersector, setup.batch_paths), block_(method_, setup.path, shared) {}

    /// Traces paths until the source has no more, and finishes those under way.
    PassCounters run(PathSource& source) {
        fill(source);
        while (active_ > 0) {
            solid_hits_.find_closest(rays_, active_);
            numbers_.draw(setup_.path, active_);
            extend();
            if constexpr (kSamplesLights) connect();
            retire(source);
        }
        if constexpr (GuidedMethod<M>) block_.records.commit();
        return counters_;
    }

private:
    static constexpr bool kSamplesLights = F.has(Feature::NextEventEstimation);

    [[gnu::flatten, gnu::noinline]] void fill(PathSource& source) {
        while (active_ < setup_.batch_paths && start(source, active_)) ++active_;
    }

    /// Puts the next path of the source into place i. Returns false if there is none.
    PL_INLINE bool start(PathSource& source, std::uint32_t i) {
        std::uint32_t number = 0;
        Vec4f u;
        if (!source.next(number, u)) return false;
        // Made in its place: copying what was just written in smaller pieces would wait for the writes.
        ::new (static_cast<void*>(&states_[i])) PathState<F, M>(work_.begin(number, u));
        prepare(i);
        return true;
    }

    /// Lays out path i for the loops over all paths.
    void prepare(std::uint32_t i) {
        rays_.set_ray(i, states_[i].ray);
        numbers_.set_path(i, states_[i]);
    }

    void extend() {
        shadow_count_ = 0;
        if constexpr (GuidedMethod<M>)
            extend_blocks();
        else
            extend_each();
    }

    void extend_blocks() {
        const auto end_of = [this](std::uint32_t first) { return std::min(first + kGuidedBlock, active_); };
        block_.lookups[0].begin(setup_.scene, method_.field, rays_, 0, end_of(0));
        for (std::uint32_t first = 0; first < active_; first += kGuidedBlock) {
            const std::uint32_t block = first / kGuidedBlock;
            const std::uint32_t next = end_of(first);
            LookupsAhead& lookups = block_.lookups[block % 2];
            block_.lookups[(block + 1) % 2].begin(setup_.scene, method_.field, rays_, next, end_of(next));
            lookups.finish(method_.field);
            extend_block(first, next, lookups);
        }
    }

    /// Half of the time of a small scene is spent here.
    [[gnu::flatten, gnu::noinline]] void extend_each() {
        for (std::uint32_t i = 0; i < active_; ++i) {
            ShadowRequest shadow;
            statuses_[i] = extend_path<F>(setup_.scene, method_, setup_.path, rays_.hit(i), numbers_.numbers(i),
                                          states_[i], shadow, counters_.path);
            push(shadow, i);
        }
    }

    /// Paths from `first` to `end`, in the parts of extend_path, so that directions are chosen for many at once.
    [[gnu::flatten, gnu::noinline]] void extend_block(std::uint32_t first, std::uint32_t end,
                                                      const LookupsAhead& lookups) {
        block_.departures.clear();
        for (std::uint32_t i = first; i < end; ++i) {
            ShadowRequest shadow;
            typename M::Record record{};
            const VertexNumbers numbers = numbers_.numbers(i);
            const Hit hit = rays_.hit(i);
            method_.found = lookups.found(i);
            const auto surface_of = [&]() -> decltype(auto) {
                return lookups.template surface<F>(setup_.scene, hit, i);
            };
            statuses_[i] = arrive<F>(setup_.scene, method_, setup_.path, hit, surface_of, numbers, states_[i],
                                     block_.departures.next(), record, shadow, counters_.path);
            if (statuses_[i] == PathStatus::Continues) send(i, numbers.scatter, record);
            block_.records.push(record);
            push(shadow, i);
        }
        block_.departures.choose_directions();
        for (std::uint32_t i = 0; i < block_.departures.count(); ++i) {
            const std::uint32_t path = block_.departures.path(i);
            typename M::Record none{};
            statuses_[path] = leave(method_, block_.departures.departure(i), block_.departures.direction(i),
                                    states_[path], none, counters_.path);
        }
    }

    /// Lets path i wait for its direction, which many Lambert reflectors get at once; at other surfaces it goes on alone.
    void send(std::uint32_t i, Vec4f u, typename M::Record& record) {
        if constexpr (F.has_any(kLobeFeatures)) {
            const Departure<F, M>& departure = block_.departures.next();
            if (!departure.bsdf.is_lambert()) {
                const Rng rng = path_rng(setup_.path, states_[i].pixel, states_[i].sample);
                statuses_[i] = leave_by_lobe(method_, departure, rng, u, states_[i], record, counters_.path);
                return;
            }
        }
        block_.departures.add(i, states_[i], u);
    }

    void push(const ShadowRequest& shadow, std::uint32_t path) {
        if constexpr (kSamplesLights) {
            if (!shadow.wanted) return;
            shadow_rays_.set_ray(shadow_count_, shadow.ray);
            shadow_paths_[shadow_count_] = path;
            shadows_[shadow_count_++] = shadow;
        }
    }

    [[gnu::flatten, gnu::noinline]] void connect() {
        find_blocked();
        for (std::uint32_t i = 0; i < shadow_count_; ++i)
            if (!shadow_rays_.occluded(i))
                connect_light(method_, shadows_[i], states_[shadow_paths_[i]], counters_.path);
        counters_.path.shadow_rays += shadow_count_;
    }

    /// Which shadow rays something solid is in the way of.
    void find_blocked() {
        if (!solid_hits_.wanted(setup_.scene)) return intersector_.find_occluded(shadow_rays_, shadow_count_);
        solid_hits_.find_closest(shadow_rays_, shadow_count_);
        for (std::uint32_t i = 0; i < shadow_count_; ++i) shadow_rays_.set_occluded(i, shadow_rays_.hit(i).found());
    }

    /// Hands in the finished paths and puts new ones, or the last ones, into their places.
    [[gnu::flatten, gnu::noinline]] void retire(PathSource& source) {
        for (std::uint32_t i = 0; i < active_;) {
            if (statuses_[i] == PathStatus::Finished)
                statuses_[i] = end_branch(setup_.scene, method_, setup_.path, states_[i], counters_.path);
            if (statuses_[i] == PathStatus::Continues) {
                prepare(i++);
                continue;
            }
            finish(states_[i]);
            if (start(source, i)) {
                ++i;
                continue;
            }
            --active_;
            states_[i] = states_[active_];
            statuses_[i] = statuses_[active_];
        }
    }

    void finish(const PathState<F, M>& state) {
        count_path(counters_, state.radiance, work_.finish(state, counters_.path.method));
    }

    const PassSetup& setup_;
    const I& intersector_;
    M method_;
    const W& work_;
    std::vector<PathState<F, M>> states_;
    std::vector<PathStatus> statuses_;
    NumberBatch numbers_;
    RayBatch rays_;
    std::vector<ShadowRequest> shadows_;
    std::vector<std::uint32_t> shadow_paths_;
    RayBatch shadow_rays_;
    SolidHits<F, I> solid_hits_;
    [[no_unique_address]] BlockMemory<F, M> block_;
    std::uint32_t active_ = 0;
    std::uint32_t shadow_count_ = 0;
    PassCounters counters_;
};

/// Traces the paths of `work` on all threads.
template <FeatureSet F, Method M, BatchIntersector I, PathWork<F, M> W>
PassCounters run_paths(const PassSetup& setup, const I& intersector, const M& method, const W& work) {
    ChunkQueue queue = setup.chunks(work.count());
    SharedByThreads<M> shared(method);
    std::vector<PassCounters> counters(static_cast<std::size_t>(setup.threads));
    run_on_threads(setup.threads, [&](int thread) {
        PathSource source(queue, {setup.path.seed, setup.path.stream, W::kStartPurpose, work.start_sample()});
        PathBatch<F, M, I, W> batch(setup, intersector, method, work, shared);
        counters[static_cast<std::size_t>(thread)] = batch.run(source);
    });
    PassCounters total;
    for (const PassCounters& one : counters) total += one;
    return total;
}

}  // namespace pl
