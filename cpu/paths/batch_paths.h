// The states of a batch of paths as structures of arrays, and what methods guided by tables keep in memory for each thread of a pass:
// volumes that are looked up before the paths reach their vertices, and queues of training samples.
#pragma once

#include <array>
#include <new>
#include <vector>

#include "core/kernel/methods/default.h"
#include "core/kernel/methods/targets/expected_sarsa.h"
#include "core/kernel/methods/targets/frozen.h"
#include "cpu/base/groups.h"
#include "cpu/learning/lookups_ahead.h"
#include "cpu/learning/training_queue.h"
#include "cpu/paths/pass_setup.h"

namespace pl {

/// Number of volumes that a method is guided by, if by tables.
template <class M>
std::uint32_t guiding_volumes([[maybe_unused]] const M& method) {
    if constexpr (TableGuided<M>)
        return method.field.normals.count;
    else
        return 0;
}

/// Lookups and training samples of one thread. Methods not guided by tables look up and record path by path.
template <class M>
class GuidedMemory {
public:
    GuidedMemory(const M& method, VolumeLocks& locks)
        : method_(method), training_(method, locks), lights_(method, locks) {}
    void record(const typename M::Sample& sample) {
        if constexpr (!TableGuided<M>)
            method_.record(sample);
        else if constexpr (kQueuesSamples)
            training_.push(sample);
    }
    void record_light(const typename M::Light& light, bool is_visible) {
        if constexpr (!TableGuided<M>)
            method_.record_light(light, is_visible);
        else if constexpr (kQueuesLights)
            lights_.push(light, is_visible);
    }
    void flush() {
        if constexpr (kQueuesSamples) training_.flush();
        if constexpr (kQueuesLights) lights_.flush();
    }

    [[no_unique_address]] MemberIf<TableGuided<M>, std::array<LookupsAhead, 2>>
        lookups;  ///< of the current and the next block

private:
    static constexpr bool kQueuesSamples = TableGuided<M> && !std::is_empty_v<typename M::Sample>;
    static constexpr bool kQueuesLights = TableGuided<M> && !std::is_empty_v<typename M::Light>;

    const M& method_;
    [[no_unique_address]] MemberIf<kQueuesSamples, TrainingQueue<M, QueuedSample<M>>> training_;
    [[no_unique_address]] MemberIf<kQueuesLights, TrainingQueue<M, QueuedLight<M>>> lights_;
};

/// Methods whose hooks do nothing.
template <class M>
concept Hookless = std::same_as<M, DefaultMethod>;

/// Methods guided by tables whose hooks are called in lanes, see table_learning.h. Not methods derived from them,
/// which may have other hooks.
template <class M>
concept LaneLearning = TableGuided<M> &&(std::same_as<M, LookedUpAhead<Guided<TableField, ExpectedSarsa>>> ||
                                         std::same_as<M, LookedUpAhead<Guided<TableField, FrozenField>>>);

/// Whether all hooks of the method, if it has any, are called in lanes.
template <class M>
inline constexpr bool kHooksInLanes = Hookless<M> || LaneLearning<M>;

/// Whether the method is told of specular chains.
template <FeatureSet F, class M>
inline constexpr bool kTellsChains = F.has_any(kLobeFeatures) && !Hookless<M>;

/// Random numbers of a batch of paths for their next vertices, bit-identical to draw_vertex_uniforms() of each path.
class UniformBatch {
public:
    UniformBatch(std::uint32_t capacity, bool with_light)
        : counters_(group_count(capacity)), scatter_(counters_.size()), light_(with_light ? counters_.size() : 0) {}

    template <FeatureSet F, class M>
    void set_path(std::uint32_t index, const PathState<F, M>& state) {
        CounterGroup& group = counters_[index / kGroupSize];
        const std::uint32_t lane = index % kGroupSize;
        group.pixel[lane] = state.pixel;
        group.sample[lane] = state.sample;
        group.vertex[lane] = state.vertices + 1;
    }

    void move(std::uint32_t from, std::uint32_t to) {
        const CounterGroup& source = counters_[from / kGroupSize];
        CounterGroup& group = counters_[to / kGroupSize];
        group.pixel[to % kGroupSize] = source.pixel[from % kGroupSize];
        group.sample[to % kGroupSize] = source.sample[from % kGroupSize];
        group.vertex[to % kGroupSize] = source.vertex[from % kGroupSize];
    }
    std::uint32_t pixel(std::uint32_t index) const { return counters_[index / kGroupSize].pixel[index % kGroupSize]; }
    std::uint32_t sample(std::uint32_t index) const {
        return counters_[index / kGroupSize].sample[index % kGroupSize];
    }
    CounterGroup* counter_groups() { return counters_.data(); }
    const UniformGroup* scatter_groups() const { return scatter_.data(); }
    /// Null without light sampling.
    const UniformGroup* light_groups() const { return light_.empty() ? nullptr : light_.data(); }

    /// Draws the numbers of the first `count` paths.
    void draw(const PathSettings& settings, std::uint32_t count) {
        DrawKey key{settings.seed, settings.stream, Purpose::Scatter, settings.sequences};
        draw_rows(key, scatter_, count);
        key.purpose = Purpose::Light;
        if (!light_.empty()) draw_rows(key, light_, count);
    }

private:
    void draw_rows(const DrawKey& key, std::vector<UniformGroup>& rows, std::uint32_t count) const {
        kernels_.draw_vertices(key, counters_.data(), rows.data(), group_count(count));
    }

    LaneKernels kernels_ = best_lane_kernels();
    std::vector<CounterGroup> counters_;
    std::vector<UniformGroup> scatter_;
    std::vector<UniformGroup> light_;  ///< empty without light sampling
};

/// The states of a batch of paths. Members of PathState that lanes do not read have no row: the glass around a path, its specular chain,
/// its choice of lights, and the types of a method with hooks that are called path by path. Where there are any, they stay in a PathState
/// of each path, whose other members are arbitrary.
template <FeatureSet F, Method M>
class PathRows {
public:
    using State = PathState<F, M>;

    /// Whether there are members without rows.
    static constexpr bool kKeepsStates =
        !kHooksInLanes<M> || kTellsChains<F, M> || kTracksMedium<F> || learns_lights<F, M>;

    PathRows(std::uint32_t capacity, bool with_light)
        : rays(capacity), uniforms(capacity, with_light), groups_(pl::group_count(capacity)),
          open_(LaneLearning<M> ? groups_.size() : 0), states_(kKeepsStates ? capacity : 0) {}

    /// Starts path i with the state that begin() returns. `store`: of path i, or null.
    PL_INLINE void start(std::uint32_t i, [[maybe_unused]] typename M::Store* store, const auto& begin) {
        if constexpr (kKeepsStates) {
            // Constructed in place: the wide loads of a copy would stall, since narrower stores do not forward to them.
            ::new (static_cast<void*>(&states_[i])) State(begin());
            if (store != nullptr) keep_store(states_[i], store);
            set_start(i, states_[i]);
        } else {
            set_start(i, begin());
        }
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
    /// The state of path i, which is `local` where all members have rows.
    State& read(std::uint32_t i, State& local) {
        State& state = read_between(i, local);
        state.ray = rays.ray(i);
        state.pixel = uniforms.pixel(i);
        state.sample = uniforms.sample(i);
        return state;
    }
    /// The state of path i at a vertex, before it is scattered: without the ray and the counters of its random numbers.
    State& read_between(std::uint32_t i, State& local) {
        State& state = kKeepsStates ? states_[i] : local;
        const PathGroup& group = groups_[i / kGroupSize];
        const std::uint32_t lane = i % kGroupSize;
        state.throughput = group.throughput.get(lane);
        state.radiance = group.radiance.get(lane);
        state.direction_pdf_sa = group.direction_pdf_sa[lane];
        state.survival = group.survival[lane];
        state.vertices = group.vertices[lane];
        if constexpr (F.has_any(kLobeFeatures)) state.specular_vertices = group.specular[lane];
        if constexpr (kOpensSamples) state.memory = open_sample(i);
        return state;
    }
    /// Path i goes on as its state says.
    void send(std::uint32_t i, const State& state) {
        rays.set_ray(i, state.ray);
        groups_[i / kGroupSize].throughput.set(i % kGroupSize, state.throughput);
        groups_[i / kGroupSize].direction_pdf_sa[i % kGroupSize] = state.direction_pdf_sa;
        if constexpr (kOpensSamples) open_[i / kGroupSize].set(i % kGroupSize, state.memory);
    }
    /// Path `from` continues in the place of path `to`.
    void move(std::uint32_t from, std::uint32_t to) {
        rays.set_ray(to, rays.ray(from));
        uniforms.move(from, to);
        groups_[from / kGroupSize].move(from % kGroupSize, groups_[to / kGroupSize], to % kGroupSize);
        if constexpr (kKeepsStates) states_[to] = states_[from];
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

    /// Path i, of which only the members without rows are valid.
    State& beside(std::uint32_t i) requires(kKeepsStates) { return states_[i]; }
    const State& beside(std::uint32_t i) const requires(kKeepsStates) { return states_[i]; }
    /// The learned choice of lights where path i was last scattered.
    LearnedLights learned_lights(std::uint32_t i) const {
        if constexpr (learns_lights<F, M>)
            return states_[i].lights;
        else
            return {};
    }
    Vec3f throughput(std::uint32_t i) const { return groups_[i / kGroupSize].throughput.get(i % kGroupSize); }
    float survival(std::uint32_t i) const { return groups_[i / kGroupSize].survival[i % kGroupSize]; }
    float direction_pdf_sa(std::uint32_t i) const { return groups_[i / kGroupSize].direction_pdf_sa[i % kGroupSize]; }
    PathGroup* groups() { return groups_.data(); }

    RayBatch rays;
    UniformBatch uniforms;

private:
    static constexpr bool kOpensSamples = LaneLearning<M> && !std::is_empty_v<typename M::Sample>;

    PL_INLINE void set_start(std::uint32_t i, const State& state) {
        rays.set_ray(i, state.ray);
        uniforms.set_path(i, state);
        set_sums(i, state);
        PathGroup& group = groups_[i / kGroupSize];
        group.direction_pdf_sa[i % kGroupSize] = state.direction_pdf_sa;
        group.vertices[i % kGroupSize] = state.vertices;
        group.specular[i % kGroupSize] = 0;
        if constexpr (LaneLearning<M>) open_[i / kGroupSize].start(i % kGroupSize);
    }

    std::vector<PathGroup> groups_;
    std::vector<OpenGroup> open_;  ///< of a method that learns in lanes, else empty
    std::vector<State> states_;    ///< where there are members without rows, else empty
};

/// The paths of a batch, with what their steps need.
template <FeatureSet F, Method M>
struct Paths {
    Paths(const PassSetup& arguments, const M& of, VolumeLocks& locks)
        : setup(arguments), method(of), guided(method, locks), rows(arguments.batch_paths, samples_lights()) {}
    Paths(const Paths&) = delete;
    Paths& operator=(const Paths&) = delete;

    bool samples_lights() const { return F.has(Feature::NextEventEstimation) && setup.path.next_event != 0; }
    /// Points of instances are made, and their volumes found, path by path.
    bool can_look_ahead() const { return !shows_instances<F>(setup.scene); }
    /// The lookups of the block of path i, while the lookups of the next block are under way.
    auto& lookups_of(std::uint32_t i) requires(TableGuided<M>) { return guided.lookups[i / kPathBlock % 2]; }
    StepOutput<M> output(typename M::Sample& sample) { return {sample, counters.path}; }

    const PassSetup& setup;
    M method;
    const PathContext<M> context{setup.scene, method, setup.path};
    GuidedMemory<M> guided;
    LaneKernels kernels = best_lane_kernels();
    PassCounters counters;
    PathRows<F, M> rows;
};

}  // namespace pl
