// The paths of a batch that stay in SIMD lanes: their states as structures of arrays, and their shadow rays, whose contributions wait in
// the lanes of the paths.
#pragma once

#include <new>
#include <vector>

#include "core/kernel/methods/default.h"
#include "core/kernel/methods/targets/expected_sarsa.h"
#include "core/kernel/methods/targets/frozen.h"
#include "cpu/base/groups.h"
#include "cpu/base/uniform_batch.h"
#include "cpu/learning/lookups_ahead.h"
#include "cpu/learning/training_queue.h"
#include "cpu/paths/batch_paths.h"
#include "cpu/paths/light_block.h"
#include "cpu/paths/vertex_block.h"

namespace pl {

/// Methods whose hooks do nothing.
template <class M>
concept Hookless = std::same_as<M, DefaultMethod>;

/// Methods guided by tables whose hooks are called in lanes, see table_learning.h. Not those derived from them, which may have other hooks.
template <class M>
concept LaneLearning = TableGuided<M> &&(std::same_as<M, LookedUpAhead<Guided<TableField, ExpectedSarsa>>> ||
                                         std::same_as<M, LookedUpAhead<Guided<TableField, FrozenField>>>);

/// The states of a batch of paths. The members of PathState of which a method has a type of its own stay in a PathState of each path, whose
/// other members are arbitrary.
template <FeatureSet F, Method M>
class PathRows {
public:
    using State = PathState<F, M>;

    PathRows(std::uint32_t capacity, bool with_light)
        : rays(capacity), uniforms(capacity, with_light), groups_(pl::group_count(capacity)),
          open_(LaneLearning<M> ? groups_.size() : 0), states_(kHooksInLanes ? 0 : capacity) {}

    /// Whether all hooks of the method, if it has any, are called in lanes.
    static constexpr bool kHooksInLanes = Hookless<M> || LaneLearning<M>;

    /// Starts path i.
    void start(std::uint32_t i, const State& state) {
        rays.set_ray(i, state.ray);
        uniforms.set_path(i, state);
        set_sums(i, state);
        PathGroup& group = groups_[i / kGroupSize];
        group.direction_pdf_sa[i % kGroupSize] = state.direction_pdf_sa;
        group.vertices[i % kGroupSize] = state.vertices;
        if constexpr (LaneLearning<M>) open_[i / kGroupSize].start(i % kGroupSize);
    }
    /// The radiance, throughput and survival of path i.
    void set_sums(std::uint32_t i, const State& state) {
        PathGroup& group = groups_[i / kGroupSize];
        group.throughput.set(i % kGroupSize, state.throughput);
        group.radiance.set(i % kGroupSize, state.radiance);
        group.survival[i % kGroupSize] = state.survival;
    }
    /// Calls step(state) for the state of path i, and keeps its radiance, throughput and survival.
    void with_state(std::uint32_t i, const auto& step) {
        State local;
        State& state = read(i, local);
        step(state);
        set_sums(i, state);
    }
    /// The state of path i, which is `local` where all hooks are called in lanes.
    State& read(std::uint32_t i, State& local) {
        State& state = kHooksInLanes ? local : states_[i];
        state.ray = rays.ray(i);
        state.pixel = uniforms.pixel(i);
        state.sample = uniforms.sample(i);
        read_sums(i, state);
        return state;
    }
    /// Path `from` continues in the place of path `to`.
    void move(std::uint32_t from, std::uint32_t to) {
        rays.set_ray(to, rays.ray(from));
        uniforms.move(from, to);
        State state;
        read_sums(from, state);
        set_sums(to, state);
        groups_[to / kGroupSize].direction_pdf_sa[to % kGroupSize] = state.direction_pdf_sa;
        groups_[to / kGroupSize].vertices[to % kGroupSize] = state.vertices;
        if constexpr (!kHooksInLanes) states_[to] = states_[from];
        if constexpr (LaneLearning<M>)
            open_[from / kGroupSize].move(from % kGroupSize, open_[to / kGroupSize], to % kGroupSize);
    }

    /// With hooks in lanes: the open training sample of path i.
    OpenSample<TableField> open_sample(std::uint32_t i) const requires(LaneLearning<M>) {
        const OpenGroup& group = open_[i / kGroupSize];
        const std::uint32_t lane = i % kGroupSize;
        return {.entry = {group.volume[lane], group.cell[lane]}, .bsdf_ratio = group.bsdf_ratio[lane]};
    }
    OpenGroup* open_groups() { return open_.data(); }

    /// The method's part of path i; see above.
    State& of_method(std::uint32_t i) requires(!Hookless<M>) { return states_[i]; }
    Vec3f throughput(std::uint32_t i) const { return groups_[i / kGroupSize].throughput.get(i % kGroupSize); }
    float survival(std::uint32_t i) const { return groups_[i / kGroupSize].survival[i % kGroupSize]; }
    PathGroup* groups() { return groups_.data(); }

    RayBatch rays;
    UniformBatch uniforms;

private:
    void read_sums(std::uint32_t i, State& state) const {
        const PathGroup& group = groups_[i / kGroupSize];
        const std::uint32_t lane = i % kGroupSize;
        state.throughput = group.throughput.get(lane);
        state.radiance = group.radiance.get(lane);
        state.direction_pdf_sa = group.direction_pdf_sa[lane];
        state.survival = group.survival[lane];
        state.vertices = group.vertices[lane];
    }

    std::vector<PathGroup> groups_;
    std::vector<OpenGroup> open_;  ///< of a method that learns in lanes, else empty
    std::vector<State> states_;    ///< for hooks that are called path by path, else empty
};

/// The paths of a batch.
template <FeatureSet F, Method M>
struct LanePaths : BatchPaths<F, M> {
    LanePaths(const PassSetup& arguments, const M& of, SharedByThreads<M>& shared)
        : BatchPaths<F, M>(arguments, of, shared), rows(arguments.batch_paths, this->samples_lights()) {}

    static constexpr bool can_look_ahead() { return true; }

    RayBatch& rays() { return rows.rays; }
    UniformBatch& uniforms() { return rows.uniforms; }
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

/// The shadow rays of these paths.
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
    /// Returns the paths in `lit` that see their lights. `ray`: index of their first shadow ray; leaves as the index of the next block's.
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
