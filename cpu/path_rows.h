// The states of a batch of paths as structures of arrays.
#pragma once

#include <vector>

#include "core/kernel/methods/default.h"
#include "cpu/number_batch.h"
#include "cpu/path_groups.h"

namespace pl {

/// Methods whose hooks do nothing.
template <class M>
concept Hookless = std::same_as<M, DefaultMethod>;

/// The members of PathState of which a method has a type of its own stay in a PathState of each path, whose other members are arbitrary.
template <FeatureSet F, Method M>
class PathRows {
public:
    using State = PathState<F, M>;

    PathRows(std::uint32_t capacity, bool with_light)
        : rays(capacity), numbers(capacity, with_light), groups_(pl::group_count(capacity)),
          states_(Hookless<M> ? 0 : capacity) {}

    /// Starts or restarts path i.
    void set(std::uint32_t i, const State& state) {
        rays.set_ray(i, state.ray);
        numbers.set_path(i, state);
        set_sums(i, state);
        PathGroup& group = groups_[i / kGroupSize];
        group.direction_pdf_sa[i % kGroupSize] = state.direction_pdf_sa;
        group.vertices[i % kGroupSize] = state.vertices;
    }
    /// Calls step(state) for the state of path i, and keeps its radiance, throughput and survival.
    void with_state(std::uint32_t i, const auto& step) {
        State local;
        State& state = read(i, local);
        step(state);
        set_sums(i, state);
    }
    /// The state of path i, which is `local` for methods without hooks.
    State& read(std::uint32_t i, State& local) {
        State& state = Hookless<M> ? local : states_[i];
        state.ray = rays.ray(i);
        state.pixel = numbers.pixel(i);
        state.sample = numbers.sample(i);
        read_sums(i, state);
        return state;
    }
    /// Path `from` continues in the place of path `to`.
    void move(std::uint32_t from, std::uint32_t to) {
        rays.set_ray(to, rays.ray(from));
        numbers.move(from, to);
        State state;
        read_sums(from, state);
        set_sums(to, state);
        groups_[to / kGroupSize].direction_pdf_sa[to % kGroupSize] = state.direction_pdf_sa;
        groups_[to / kGroupSize].vertices[to % kGroupSize] = state.vertices;
        if constexpr (!Hookless<M>) states_[to] = states_[from];
    }

    /// The method's part of path i; see above.
    State& of_method(std::uint32_t i) requires(!Hookless<M>) { return states_[i]; }
    Vec3f throughput(std::uint32_t i) const { return groups_[i / kGroupSize].throughput.get(i % kGroupSize); }
    float survival(std::uint32_t i) const { return groups_[i / kGroupSize].survival[i % kGroupSize]; }
    PathGroup* groups() { return groups_.data(); }

    RayBatch rays;
    NumberBatch numbers;

private:
    void set_sums(std::uint32_t i, const State& state) {
        PathGroup& group = groups_[i / kGroupSize];
        group.throughput.set(i % kGroupSize, state.throughput);
        group.radiance.set(i % kGroupSize, state.radiance);
        group.survival[i % kGroupSize] = state.survival;
    }
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
    std::vector<State> states_;  ///< empty for methods without hooks
};

}  // namespace pl
