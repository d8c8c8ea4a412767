// The main loop on the CPU: each thread advances a batch of paths, one stage at a time for all of them, so that the
// intersector always has full vectors. The radiance of a path depends only on its number; batch size, threads and
// chunks affect speed only.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <new>
#include <vector>

#include "core/kernel/integrator/steps.h"
#include "core/session/backend.h"
#include "cpu/guided_block.h"
#include "cpu/light_candidates.h"
#include "cpu/path_source.h"
#include "cpu/ray_batch.h"
#include "cpu/solid_hits.h"

namespace pl {

/// Arguments common to all passes.
struct PassSetup {
    SceneView scene;
    PathSettings path;
    IndexRange paths{0, kToTheLast};  ///< numbers of the paths to trace, clamped to those of the pass
    const StopFlag* stop = nullptr;
    int threads = 1;
    std::uint32_t batch_paths = 1024;

    /// Chunks of the paths to trace; the pass has `count` paths.
    ChunkQueue chunks(std::uint32_t count) const {
        return ChunkQueue(paths.begin, std::min(paths.end, count), kPathChunk, stop);
    }
};

/// A set of paths numbered from 0: creates their first rays and stores their radiance. start_key() decides their random
/// numbers at vertex 0; finish() returns true if the sample is valid.
template <class W, FeatureSet F, class M>
concept PathWork = requires(const W& work, const PathSettings& path, std::uint32_t number, Vec4f u,
                            const PathState<F, M>& state, PassCounters& counters) {
    { work.count() } -> std::same_as<std::uint32_t>;
    { work.start_key(path) } -> std::same_as<StartKey>;
    { work.begin(number, u) } -> std::same_as<PathState<F, M>>;
    { work.finish(state, counters) } -> std::same_as<bool>;
};

/// The batch of one thread, active paths first. Each stage is one function with all calls inlined, so that its
/// machine code does not depend on the other sets of features in the same translation unit.
template <FeatureSet F, Method M, BatchIntersector I, PathWork<F, M> W>
class PathBatch {
public:
    PathBatch(const PassSetup& setup, const I& intersector, const M& method, const W& work,
              SharedByThreads<M>& shared)
        : setup_(setup), intersector_(intersector), method_(method), work_(work), states_(setup.batch_paths),
          stores_(needs_store<M>(setup.path) ? setup.batch_paths : 0), statuses_(setup.batch_paths),
          numbers_(setup.batch_paths, kSamplesLights && setup.path.next_event != 0), rays_(setup.batch_paths),
          shadows_(kSamplesLights ? setup.batch_paths : 0), shadow_paths_(shadows_.size()),
          shadow_rays_(static_cast<std::uint32_t>(shadows_.size())),
          solid_hits_(setup.scene, intersector, setup.batch_paths), block_(method_, shared) {}

    /// The main loop: traces paths until the source is empty and the last path has ended.
    PassCounters run(PathSource& source) {
        fill(source);
        while (active_ > 0) {
            solid_hits_.find_closest(rays_, active_);
            numbers_.draw(setup_.path, active_);
            extend();
            if constexpr (kSamplesLights) connect();
            retire(source);
        }
        if constexpr (TableGuided<M>) {
            block_.training.flush();
            block_.lights.flush();
        }
        return counters_;
    }

private:
    static constexpr bool kSamplesLights = F.has(Feature::NextEventEstimation);
    /// Whether lights are sampled by blocks. Methods whose light_sampled() has to come before a path is scattered sample them path by
    /// path, unless a block is scattered after its lights.
    static constexpr bool kSamplesLightsInLanes =
        kSamplesLights && (TableGuided<M> || std::is_same_v<typename M::Light, MethodHooks::Light>);

    [[gnu::flatten, gnu::noinline]] void fill(PathSource& source) {
        while (active_ < setup_.batch_paths && start(source, active_)) ++active_;
    }

    /// Starts the next path of the source in slot i. Returns false if the source is empty.
    PL_INLINE bool start(PathSource& source, std::uint32_t i) {
        std::uint32_t number = 0;
        Vec4f u;
        if (!source.next(number, u)) return false;
        // Constructed in place: the wide loads of a copy would stall, since narrower stores do not forward to them.
        ::new (static_cast<void*>(&states_[i])) PathState<F, M>(work_.begin(number, u));
        // Paths move only when no further ones start: then the store in the place of a path that has moved is still its own.
        if (!stores_.empty()) keep_store(states_[i], &stores_[i]);
        prepare(i);
        return true;
    }

    /// Copies ray and random-number counter of path i into the arrays of the batch.
    void prepare(std::uint32_t i) {
        rays_.set_ray(i, states_[i].ray);
        numbers_.set_path(i, states_[i]);
    }

    void extend() {
        shadow_count_ = 0;
        if constexpr (TableGuided<M>)
            extend_blocks();
        else
            for (std::uint32_t first = 0; first < active_; first += kGuidedBlock)
                extend_each(first, std::min(first + kGuidedBlock, active_));
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

    /// Shades and scatters paths [first, end) one by one: most of the run time of a small scene. Their lights may be sampled after that.
    [[gnu::flatten, gnu::noinline]] void extend_each(std::uint32_t first, std::uint32_t end) {
        if constexpr (kSamplesLightsInLanes) candidates_.clear();
        for (std::uint32_t i = first; i < end; ++i) {
            const VertexNumbers numbers = numbers_.numbers(i);
            statuses_[i] = extend_path<F>(
                context_, rays_.hit(i), numbers, states_[i],
                [&](const ScatterPoint<F, M>& from) { request_light_later(i, from, numbers.light); }, counters_.path);
        }
        if constexpr (kSamplesLightsInLanes) request_lights();
    }

    /// The same for paths [first, end) in two loops, so that directions are sampled in SIMD lanes.
    [[gnu::flatten, gnu::noinline]] void extend_block(std::uint32_t first, std::uint32_t end,
                                                      const LookupsAhead& lookups) {
        block_.scattered.clear();
        if constexpr (kSamplesLightsInLanes) candidates_.clear();
        for (std::uint32_t i = first; i < end; ++i) shade_ahead(i, lookups);
        if constexpr (kSamplesLightsInLanes) request_lights();
        block_.scattered.sample_directions();
        for (std::uint32_t i = 0; i < block_.scattered.count(); ++i) {
            const std::uint32_t path = block_.scattered.path(i);
            typename M::Sample none{};
            statuses_[path] = scatter_lambert(method_, block_.scattered.point(i), block_.scattered.direction(i),
                                              states_[path], StepOutput<M>{none, counters_.path});
        }
    }

    /// Shades path i with the surface point and volume of `lookups`.
    void shade_ahead(std::uint32_t i, const LookupsAhead& lookups) {
        typename M::Sample sample{};
        const StepOutput<M> out{sample, counters_.path};
        const VertexNumbers numbers = numbers_.numbers(i);
        const Hit hit = rays_.hit(i);
        method_.found = lookups.found(i);
        const auto surface_of = [&]() -> decltype(auto) { return lookups.template surface<F>(setup_.scene, hit, i); };
        ScatterPoint<F, M>& from = block_.scattered.next();
        statuses_[i] = shade_hit<F, M>(context_, hit, surface_of, states_[i], {out, from});
        if (statuses_[i] == PathStatus::Continues) {
            request_light_later(i, from, numbers.light);
            statuses_[i] = continue_path(context_, hit, numbers.scatter.w, states_[i], from, out);
        }
        if (statuses_[i] == PathStatus::Continues) scatter_later(i, numbers.scatter, out);
        block_.training.push(sample);
    }

    /// Samples a light for path i at the vertex `from`, with those of the other paths of the block if lanes can.
    void request_light_later(std::uint32_t i, const ScatterPoint<F, M>& from, Vec4f u) {
        if constexpr (kSamplesLights) {
            if (setup_.path.next_event == 0) return;
            if constexpr (kSamplesLightsInLanes) {
                if (candidates_.takes(from, u)) return candidates_.add(i, from, u, received_weights(states_[i]));
            }
            ShadowRequest<M> shadow;
            request_light(context_, from, u, states_[i], shadow);
            push(shadow, i);
        }
    }
    /// Samples the lights of a block, and weighs them.
    void request_lights() {
        candidates_.sample();
        if constexpr (TableGuided<M>) block_.lit.clear();
        for (std::uint32_t k = 0; k < candidates_.count(); ++k) {
            const UnweightedLight light = candidates_.light(k);
            const ScatterPoint<F, M>& from = candidates_.point(k);
            const std::uint32_t path = candidates_.path(k);
            if (!(light.pdf_sa > 0.0f))
                weigh(path, from.vertex, light, 0.0f);
            else if constexpr (TableGuided<M>)
                block_.lit.add(path, from, light);
            else
                weigh(path, from.vertex, light, scatter_pdf_sa(method_, from, light.wi));
        }
        if constexpr (TableGuided<M>) weigh_lights();
    }
    void weigh_lights() {
        block_.lit.weigh_directions();
        for (std::uint32_t k = 0; k < block_.lit.count(); ++k)
            weigh(block_.lit.path(k), block_.lit.vertex(k), block_.lit.light(k), block_.lit.pdf_sa(k));
    }
    void weigh(std::uint32_t path, const typename M::Vertex& vertex, const UnweightedLight& light,
               float scatter_pdf) {
        ShadowRequest<M> shadow;
        weigh_light<F>(method_, vertex, light, scatter_pdf, states_[path], shadow);
        push(shadow, path);
    }

    /// Queues path i for the sampling of its direction at a Lambert reflector; scatters it at once at other surfaces.
    void scatter_later(std::uint32_t i, Vec4f u, const StepOutput<M>& out) {
        if constexpr (F.has_any(kLobeFeatures)) {
            const ScatterPoint<F, M>& from = block_.scattered.next();
            if (!from.bsdf.is_lambert()) {
                statuses_[i] =
                    scatter_layered(method_, from, scatter_numbers(setup_.path, states_[i], u), states_[i], out);
                return;
            }
        }
        block_.scattered.add(i, u);
    }

    void push(const ShadowRequest<M>& shadow, std::uint32_t path) {
        if constexpr (kSamplesLights) {
            if (!shadow.wanted) return record_light(shadow, false);
            shadow_rays_.set_ray(shadow_count_, shadow.ray);
            shadow_paths_[shadow_count_] = path;
            shadows_[shadow_count_++] = shadow;
        }
    }

    [[gnu::flatten, gnu::noinline]] void connect() {
        find_blocked();
        for (std::uint32_t i = 0; i < shadow_count_; ++i) {
            const bool is_visible = !shadow_rays_.occluded(i);
            if (is_visible) connect_light(method_, shadows_[i], states_[shadow_paths_[i]], counters_.path);
            record_light(shadows_[i], is_visible);
        }
        counters_.path.shadow_rays += shadow_count_;
    }

    void record_light(const ShadowRequest<M>& shadow, bool is_visible) {
        if constexpr (TableGuided<M>)
            block_.lights.push(shadow.light, is_visible);
        else
            method_.record_light(shadow.light, is_visible);
    }

    /// Marks the shadow rays that are occluded.
    void find_blocked() {
        if (!solid_hits_.wanted(setup_.scene)) return intersector_.find_occluded(shadow_rays_, shadow_count_);
        solid_hits_.find_closest(shadow_rays_, shadow_count_);
        for (std::uint32_t i = 0; i < shadow_count_; ++i) shadow_rays_.set_occluded(i, shadow_rays_.hit(i).found());
    }

    /// Finishes ended paths and refills their slots with new paths, or with the last paths of the batch.
    [[gnu::flatten, gnu::noinline]] void retire(PathSource& source) {
        for (std::uint32_t i = 0; i < active_;) {
            if (statuses_[i] == PathStatus::Finished)
                statuses_[i] = finish_branch(context_, states_[i], counters_.path);
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
        count_path(counters_, state.radiance, work_.finish(state, counters_));
    }

    const PassSetup& setup_;
    const I& intersector_;
    M method_;
    const PathContext<M> context_{setup_.scene, method_, setup_.path};
    const W& work_;
    std::vector<PathState<F, M>> states_;
    std::vector<PathStore<M>> stores_;  ///< empty if paths need none
    std::vector<PathStatus> statuses_;
    NumberBatch numbers_;
    RayBatch rays_;
    std::vector<ShadowRequest<M>> shadows_;
    std::vector<std::uint32_t> shadow_paths_;
    RayBatch shadow_rays_;
    SolidHits<F, I> solid_hits_;
    [[no_unique_address]] LightCandidates<F, M> candidates_{context_};
    [[no_unique_address]] BlockMemory<F, M> block_;
    std::uint32_t active_ = 0;
    std::uint32_t shadow_count_ = 0;
    PassCounters counters_;
};

/// Traces the paths of `work` on setup.threads threads.
template <FeatureSet F, Method M, BatchIntersector I, PathWork<F, M> W>
PassCounters run_paths(const PassSetup& setup, const I& intersector, const M& method, const W& work) {
    ChunkQueue queue = setup.chunks(work.count());
    SharedByThreads<M> shared(method);
    std::vector<PassCounters> counters(static_cast<std::size_t>(setup.threads));
    run_on_threads(setup.threads, [&](int thread) {
        PathSource source(queue, work.start_key(setup.path));
        PathBatch<F, M, I, W> batch(setup, intersector, method, work, shared);
        counters[static_cast<std::size_t>(thread)] = batch.run(source);
    });
    PassCounters total;
    for (const PassCounters& one : counters) total += one;
    return total;
}

}  // namespace pl
