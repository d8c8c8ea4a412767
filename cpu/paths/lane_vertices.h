// The vertices of a block of paths in SIMD lanes: from hits to the next rays. Rare events leave the lanes for the steps of one path and
// come back: emission that is hit, and a miss. So do the hooks of methods that have none in lanes.
#pragma once

#include "core/kernel/integrator/steps.h"
#include "cpu/paths/direction_block.h"
#include "cpu/paths/lane_paths.h"
#include "cpu/paths/table_learning.h"
#include "cpu/paths/vertex_block.h"

namespace pl {

template <FeatureSet F, Method M>
class LaneVertices {
public:
    explicit LaneVertices(LanePaths<F, M>& paths) : paths_(paths) {}

    /// Call once before extend() is called for the blocks of the first `active` paths.
    void begin(std::uint32_t /*active*/) {}
    /// Shades and scatters the `count` paths from `first` on, a multiple of kPathBlock, and packs their shadow rays. Returns the paths
    /// that have ended, one bit each.
    [[gnu::flatten, gnu::noinline]] std::uint64_t extend(std::uint32_t first, std::uint32_t count,
                                                         LaneShadows<F, M>& shadows) {
        first_ = first;
        block_ = block_of(count);
        vertices_.clear(count);
        if constexpr (LaneLearning<M>) {
            directions_.clear();
            learning_.begin(first, block_, directions_.guided());
        }
        const std::uint64_t reached = shade(count);
        vertices_.set_reached(reached);
        const std::uint64_t continuing = continue_paths(reached);
        vertices_.set_continuing(continuing);
        if constexpr (kHooksInLanes)
            directions_.complete(vertices_);
        else
            add_directions(paths_.samples_lights() ? reached : continuing);
        if constexpr (F.has(Feature::NextEventEstimation)) {
            if (paths_.samples_lights()) request_lights(reached, shadows);
        }
        return first_bits(count) & ~scatter(continuing);
    }

private:
    using State = PathState<F, M>;
    static constexpr bool kHooksInLanes = PathRows<F, M>::kHooksInLanes;

    /// Number of path k of the block in the batch.
    std::uint32_t path(std::uint32_t k) const { return first_ + k; }

    BlockRows block_of(std::uint32_t count) {
        const std::uint32_t group = first_ / kGroupSize;
        UniformBatch& uniforms = paths_.rows.uniforms;
        const UniformGroup* light = uniforms.light_groups();
        return {.hits = paths_.rows.rays.hit_groups() + group,
                .points = points_at_hits(count),
                .scatter = uniforms.scatter_groups() + group,
                .light = light == nullptr ? nullptr : light + group,
                .counters = uniforms.counter_groups() + group,
                .paths = paths_.rows.groups() + group,
                .vertices = vertices_.groups(),
                .groups = group_count(count)};
    }
    const PointGroup* points_at_hits([[maybe_unused]] std::uint32_t count) {
        if constexpr (TableGuided<M>) {
            return paths_.lookups_of(first_).surfaces().points();
        } else {
            const SceneView& scene = paths_.setup.scene;
            surfaces_.find(scene, rows_of(scene), paths_.rays(), first_, first_ + count);
            return surfaces_.points();
        }
    }

    /// Adds the emission at the ends of the segments, and calls observe() of the method. Returns the paths that reach a vertex from
    /// which they may go on.
    std::uint64_t shade(std::uint32_t count) {
        SegmentMarks marks;
        if (has_surfaces(paths_.setup.scene))
            paths_.kernels.reach_vertices(surface_rows<F>(paths_.setup.scene), paths_.setup.path.max_depth, block_,
                                          marks);
        const std::uint64_t hit = marks.hit.bits() & first_bits(count);
        const std::uint64_t scattering = marks.scatters.bits() & hit;
        const std::uint64_t truncated = marks.is_deepest.bits() & scattering;
        paths_.counters.path.segments += count;
        paths_.counters.path.truncated += static_cast<std::uint64_t>(std::popcount(truncated));
        for_bits(first_bits(count) & ~hit, [&](std::uint32_t k) { miss(path(k)); });
        const std::uint64_t emitting = marks.emits.bits() & hit;
        const std::uint64_t reached = scattering & ~truncated;
        if constexpr (kHooksInLanes) {
            for_bits(emitting, [&](std::uint32_t k) {
                [[maybe_unused]] const Observation emission = add_emission_at(k);
                if constexpr (LaneLearning<M>) learning_.add_emission(k, emission);
            });
            if constexpr (LaneLearning<M>) learning_.observe({hit, scattering, reached}, vertices_);
        } else {
            for_bits(hit, [&](std::uint32_t k) {
                const bool emits = ((emitting >> k) & 1u) != 0;
                observe(k, emits ? add_emission_at(k) : Observation{}, ((reached >> k) & 1u) != 0);
            });
            terminate(truncated);
        }
        return reached;
    }
    void miss(std::uint32_t i) {
        typename M::Sample sample{};
        if constexpr (F.has(Feature::Environment) || !Hookless<M>)
            paths_.rows.with_state(i, [&](State& state) {
                if constexpr (LaneLearning<M>) state.memory = as_memory(paths_.rows.open_sample(i));
                shade_miss(paths_.context, state, paths_.output(sample));
            });
        else
            ++paths_.counters.path.escaped;
        paths_.guided.record(sample);
    }
    /// The memory of a method with hooks in lanes that has this training sample open.
    static typename M::Memory as_memory([[maybe_unused]] const OpenSample<TableField>& sample) {
        if constexpr (std::is_empty_v<typename M::Sample>)
            return {};
        else
            return sample;
    }
    /// Returns the emission, and its share, as an observation of nothing else.
    Observation add_emission_at(std::uint32_t k) {
        const SurfacePoint surface = surface_at(k);
        const Hit hit = paths_.rows.rays.hit(path(k));
        const Vec3f emitted = emitted_at<F>(paths_.setup.scene, surface, hit_weights(hit));
        float share = 1.0f;
        paths_.rows.with_state(path(k), [&](State& state) {
            const SurfaceAhead<F, M> ahead{paths_.setup.scene, hit, state};
            share = add_emission<F>(paths_.context, ahead, surface, emitted, state);
        });
        return {.emitted = emitted, .direction_share = share};
    }
    SurfacePoint surface_at(std::uint32_t k) const {
        SurfacePoint surface = vertices_.surface(k);
        const PointGroup& points = block_.points[k / kGroupSize];
        surface.material = points.material[k % kGroupSize];
        surface.front = points.front[k % kGroupSize] != 0;
        return surface;
    }
    ScatterPoint<F, M> scatter_point(std::uint32_t k) const {
        return {surface_at(k), {vertices_.albedo(k)}, vertices_.vertex(k)};
    }

    /// Plays roulette at the vertices. Returns the paths that go on.
    std::uint64_t continue_paths(std::uint64_t reached) {
        const float* estimates = Hookless<M> ? nullptr : estimates_;
        if constexpr (LaneLearning<M>) estimates = learning_.estimate(reached);
        BlockBits survivors;
        paths_.kernels.play_roulette(paths_.setup.path, block_, estimates, survivors);
        const std::uint64_t continuing = survivors.bits() & reached;
        if constexpr (!kHooksInLanes) terminate(reached & ~continuing);
        return continuing;
    }

    /// Samples and weighs the lights of the vertices, and packs their shadow rays.
    void request_lights(std::uint64_t reached, LaneShadows<F, M>& shadows) {
        lights_.sample(vertices_);
        directions_.weigh_lights(vertices_, lights_.groups());
        lights_.weigh(vertices_, directions_.groups());
        shadows.pack(first_, block_, vertices_, lights_, reached);
    }

    /// Returns the paths that go on into a new direction.
    std::uint64_t scatter(std::uint64_t continuing) {
        directions_.sample(vertices_);
        BlockBits lit;
        paths_.kernels.scatter_paths(block_, directions_.groups(),
                                     paths_.rows.rays.ray_groups() + first_ / kGroupSize, lit);
        const std::uint64_t black = continuing & ~lit.bits();
        paths_.counters.path.zero_directions += static_cast<std::uint64_t>(std::popcount(black));
        if constexpr (kHooksInLanes) {
            if constexpr (LaneLearning<M>) learning_.scattered(directions_.groups(), continuing & ~black);
        } else {
            terminate(black);
            for_bits(continuing & ~black, [&](std::uint32_t k) { leave(k); });
        }
        return continuing & ~black;
    }

    // The hooks of a method that learns, path by path.

    /// `reaches`: whether the path may go on from the vertex.
    void observe(std::uint32_t k, Observation observation, bool reaches) {
        const LambertBsdf bsdf{vertices_.albedo(k)};
        observation.albedo = bsdf.albedo();
        observation.distance = block_.hits[k / kGroupSize].t[k % kGroupSize];
        if constexpr (TableGuided<M>) {
            paths_.method.is_found = paths_.lookups_of(first_).is_found(path(k));
            paths_.method.found = paths_.lookups_of(first_).found(path(k));
        }
        typename M::Sample sample{};
        State& state = paths_.rows.of_method(path(k));
        const typename M::Vertex vertex =
            observe_vertex<F>(paths_.method, surface_at(k), bsdf, observation, state, paths_.output(sample));
        paths_.guided.record(sample);
        if (!reaches) return;
        vertices_.set_vertex(k, vertex);
        const float survival = paths_.rows.survival(path(k)) * max_component(bsdf.albedo());
        estimates_[k] = paths_.method.estimate_contribution(vertex, bsdf.albedo(), paths_.rows.throughput(path(k)),
                                                            survival, state.expectation);
    }
    void add_directions(std::uint64_t vertices) {
        directions_.clear();
        for_bits(vertices,
                 [&](std::uint32_t k) { directions_.add(vertices_, k, scatter_point(k), scatter_uniforms_of(k)); });
        directions_.complete(vertices_);
    }
    ScatterUniforms scatter_uniforms_of(std::uint32_t k) const {
        const UniformBatch& uniforms = paths_.rows.uniforms;
        return {.rng = path_rng(paths_.setup.path, uniforms.pixel(path(k)), uniforms.sample(path(k))),
                .index = block_.counters[k / kGroupSize].vertex[k % kGroupSize] - 1,
                .u = block_.scatter[k / kGroupSize].get(k % kGroupSize)};
    }
    void terminate(std::uint64_t paths) {
        for_bits(paths, [&](std::uint32_t k) {
            typename M::Sample sample{};
            terminate_path(paths_.method, paths_.rows.of_method(path(k)), paths_.output(sample));
            paths_.guided.record(sample);
        });
    }
    void leave(std::uint32_t k) {
        const PathGroup& group = block_.paths[k / kGroupSize];
        const std::uint32_t lane = k % kGroupSize;
        leave_vertex(paths_.method, vertices_.vertex(k),
                     {group.roulette_weight[lane] * group.weight.get(lane), vertices_.albedo(k),
                      directions_.groups()[k / kGroupSize].get(lane)},
                     paths_.rows.of_method(path(k)), paths_.counters.path);
    }

    LanePaths<F, M>& paths_;
    std::uint32_t first_ = 0;  ///< path of the block
    BlockRows block_{};
    LaneBlock<M> vertices_;
    SurfaceBlock surfaces_;        ///< unless the method looks volumes up ahead
    float estimates_[kPathBlock];  ///< of contributions
    [[no_unique_address]] LightBlock<F, M> lights_{paths_.context, paths_.setup.lights};
    DirectionBlock<F, M> directions_{paths_.method};
    [[no_unique_address]] TableLearning<F, M> learning_{paths_};
};

}  // namespace pl
