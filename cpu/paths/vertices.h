// The vertices of a block of paths in SIMD lanes: from hits to the next rays. What is rare, or has no lanes, leaves them for the steps of one
// path and comes back: emission that is hit, a miss, surfaces with images or lobes, and the hooks of methods that have none in lanes.
#pragma once

#include "core/kernel/integrator/steps.h"
#include "cpu/paths/direction_block.h"
#include "cpu/paths/shadows.h"
#include "cpu/paths/single_surfaces.h"
#include "cpu/paths/table_learning.h"
#include "cpu/paths/vertex_block.h"

namespace pl {

template <FeatureSet F, Method M>
class Vertices {
public:
    explicit Vertices(Paths<F, M>& paths) : paths_(paths) {}

    /// Call once before extend() is called for the blocks of the first `active` paths.
    void begin([[maybe_unused]] std::uint32_t active) {
        if constexpr (F.has(Feature::ManyLights)) {
            if (light_hits_.wanted()) light_hits_.find(paths_.rows, active);
        }
    }
    /// Shades and scatters the `count` paths from `first` on, a multiple of kPathBlock, and packs their shadow rays. Returns the paths
    /// that have ended, one bit each. `shadows`: Shadows, if lights are sampled.
    [[gnu::flatten, gnu::noinline]] std::uint64_t extend(std::uint32_t first, std::uint32_t count, auto& shadows) {
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
        if constexpr (kHooksInLanes<M>)
            directions_.complete(vertices_);
        else
            add_directions((paths_.samples_lights() ? reached : continuing) & ~vertices_.layered());
        if constexpr (F.has(Feature::NextEventEstimation)) {
            if (paths_.samples_lights()) request_lights(reached, shadows);
        }
        const std::uint64_t going_on = scatter(continuing);
        terminate(ended_ | (reached & ~continuing));
        return first_bits(count) & ~going_on;
    }

private:
    using State = PathState<F, M>;

    /// The surface that a path has hit, see SurfaceAhead.
    struct Ahead {
        const Vertices& vertices;
        std::uint32_t path;
        const SurfaceAhead<F, M> alone;

        float light_pdf_area(const SurfacePoint& surface) const {
            if constexpr (F.has(Feature::ManyLights)) {
                if (vertices.light_hits_.wanted()) return vertices.light_hits_.pdf_area(path, alone.hit.primitive);
            }
            return alone.light_pdf_area(surface);
        }
    };

    /// Number of path k of the block in the batch.
    std::uint32_t path(std::uint32_t k) const { return first_ + k; }
    PathGroup& group(std::uint32_t k) const { return block_.paths[k / kGroupSize]; }
    SurfacePoint surface_at(std::uint32_t k) const { return vertices_.surface(k, block_.points); }
    Hit hit_at(std::uint32_t k) const { return block_.hits[k / kGroupSize].get(k % kGroupSize); }
    static bool is_in(std::uint64_t paths, std::uint32_t k) { return ((paths >> k) & 1u) != 0; }

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
    PointGroup* points_at_hits(std::uint32_t count) {
        const SceneView& scene = paths_.setup.scene;
        if constexpr (TableGuided<M>) {
            if (paths_.can_look_ahead()) return paths_.lookups_of(first_).points();
        }
        if (shows_instances<F>(scene))
            surfaces_.template find_singly<F>(scene, paths_.rows.rays, first_, first_ + count);
        else
            surfaces_.find(scene, rows_of(scene), paths_.rows.rays, first_, first_ + count);
        return surfaces_.points();
    }

    /// Adds the emission at the ends of the segments, and calls observe() of the method. Returns the paths that reach a vertex from
    /// which they may go on.
    std::uint64_t shade(std::uint32_t count) {
        absorb(count);
        SegmentMarks marks;
        if (has_surfaces(paths_.setup.scene))
            paths_.kernels.reach_vertices(surface_rows<F>(paths_.setup.scene), paths_.setup.path.max_depth, block_,
                                          marks);
        const std::uint64_t hit = marks.hit.bits() & first_bits(count);
        std::uint64_t scattering = marks.scatters.bits() & hit;
        specular_ = 0;
        if constexpr (SingleSurfaces<F>::kAny)
            specular_ = singles_.reach(paths_.setup.path, block_, paths_.rows.rays.ray_groups() + first_ / kGroupSize,
                                       vertices_, hit, scattering);
        const std::uint64_t truncated = marks.is_deepest.bits() & scattering;
        paths_.counters.path.segments += count;
        paths_.counters.path.truncated += static_cast<std::uint64_t>(std::popcount(truncated));
        for_bits(first_bits(count) & ~hit, [&](std::uint32_t k) { miss(path(k)); });
        const std::uint64_t reached = scattering & ~truncated;
        observe(hit, marks.emits.bits() & hit, scattering, reached);
        ended_ = truncated;
        keep_vertices(reached);
        return reached;
    }
    /// Absorption in the glass around the segments.
    void absorb([[maybe_unused]] std::uint32_t count) {
        if constexpr (kTracksMedium<F>) {
            const SceneView& scene = paths_.setup.scene;
            if (scene.absorption.empty()) return;
            for (std::uint32_t k = 0; k < count; ++k)
                paths_.rows.with_state(path(k), [&](State& state) { absorb_segment(scene, hit_at(k), state); });
        }
    }
    void miss(std::uint32_t i) {
        typename M::Sample sample{};
        if constexpr (F.has(Feature::Environment) || !Hookless<M>)
            paths_.rows.with_state(i,
                                   [&](State& state) { shade_miss(paths_.context, state, paths_.output(sample)); });
        else
            ++paths_.counters.path.escaped;
        paths_.guided.record(sample);
    }
    /// Returns the emission, and its share, as an observation of nothing else.
    Observation add_emission_at(std::uint32_t k) {
        const SurfacePoint surface = surface_at(k);
        const Hit hit = hit_at(k);
        const Vec3f emitted = emitted_at<F>(paths_.setup.scene, surface, hit_weights(hit));
        if (is_black(emitted)) return {};
        float share = 1.0f;
        paths_.rows.with_state(path(k), [&](State& state) {
            const Ahead ahead{*this, path(k), {paths_.setup.scene, hit, state}};
            share = add_emission<F>(paths_.context, ahead, surface, emitted, state);
        });
        return {.emitted = emitted, .direction_share = share};
    }

    // The hooks of methods.

    /// Emission and observations at the ends of segments. The arguments are paths: those that hit a surface, which emits, reflects, and from
    /// which they may go on.
    void observe(std::uint64_t hit, std::uint64_t emitting, [[maybe_unused]] std::uint64_t scattering,
                 [[maybe_unused]] std::uint64_t reached) {
        single_ = 0;
        if constexpr (!kHooksInLanes<M>) single_ = hit;
        if constexpr (LaneLearning<M> && kTellsChains<F, M>)
            for_bits(hit, [&](std::uint32_t k) {
                const SpecularChain& chain = paths_.rows.beside(path(k)).chain;
                if (chain.is_open || chain.weight != Vec3f{1.0f} || is_in(specular_, k))
                    single_ |= std::uint64_t{1} << k;
            });
        if constexpr (LaneLearning<M>) learning_.look_up(scattering & ~specular_, reached, vertices_);
        for_bits(emitting | single_, [&](std::uint32_t k) {
            [[maybe_unused]] const Observation emission = is_in(emitting, k) ? add_emission_at(k) : Observation{};
            if constexpr (!Hookless<M>) {
                if (is_in(single_, k)) return observe_singly(k, emission, is_in(scattering, k), is_in(reached, k));
            }
            if constexpr (LaneLearning<M>) learning_.add_emission(k, emission);
        });
        if constexpr (LaneLearning<M>) learning_.complete(hit & ~single_);
    }
    void observe_singly(std::uint32_t k, Observation observation, bool scatters, [[maybe_unused]] bool reaches) {
        observation.albedo = vertices_.albedo(k);
        observation.distance = block_.hits[k / kGroupSize].t[k % kGroupSize];
        typename M::Sample sample{};
        const StepOutput<M> out = paths_.output(sample);
        State local;
        State& state = told_state(k, local);
        typename M::Vertex vertex{};
        if (is_in(specular_, k)) {
            if constexpr (F.has_any(kLobeFeatures)) extend_chain(observation, state);
        } else {
            vertex = locate(k, scatters);
            observe_end<F>(paths_.method, vertex, observation, state, out);
        }
        paths_.guided.record(sample);
        if constexpr (!kHooksInLanes<M>) {
            if (reaches) estimate(k, vertex, state);
        }
    }
    typename M::Vertex locate(std::uint32_t k, bool scatters) {
        if constexpr (LaneLearning<M>) {
            return learning_.vertex(k);
        } else {
            if (!scatters) return {};
            if constexpr (TableGuided<M>) {
                paths_.method.is_found = paths_.can_look_ahead() && paths_.lookups_of(first_).is_found(path(k));
                if (paths_.method.is_found) paths_.method.found = paths_.lookups_of(first_).found(path(k));
            }
            return paths_.method.locate(surface_at(k), paths_.counters.path.method);
        }
    }
    void estimate(std::uint32_t k, const typename M::Vertex& vertex, State& state) {
        vertices_.set_vertex(k, vertex);
        const Vec3f albedo = vertices_.albedo(k);
        const float survival = paths_.rows.survival(path(k)) * max_component(albedo);
        estimates_[k] = paths_.method.estimate_contribution(vertex, albedo, paths_.rows.throughput(path(k)), survival,
                                                            state.expectation);
    }
    /// The state of path k with the members that the method is told of.
    State& told_state(std::uint32_t k, [[maybe_unused]] State& local) {
        if constexpr (LaneLearning<M>)
            return paths_.rows.read_between(path(k), local);
        else
            return paths_.rows.beside(path(k));
    }
    /// Of paths with hooks in lanes the method is told of the ends of specular chains alone.
    void terminate(std::uint64_t paths) {
        if constexpr (kTellsChains<F, M> || !kHooksInLanes<M>)
            for_bits(kHooksInLanes<M> ? paths & specular_ : paths, [&](std::uint32_t k) {
                typename M::Sample sample{};
                State local;
                terminate_path(paths_.method, told_state(k, local), paths_.output(sample));
                paths_.guided.record(sample);
            });
    }
    /// Completes what the block keeps of its vertices besides rows.
    void keep_vertices([[maybe_unused]] std::uint64_t reached) {
        if constexpr (F.has_any(kLobeFeatures))
            for_bits(reached & vertices_.layered(),
                     [&](std::uint32_t k) { vertices_.layered(k).vertex = vertices_.vertex(k); });
        if constexpr (kTracksMedium<F>) {
            if (!paths_.setup.scene.absorption.empty())
                for_bits(reached, [&](std::uint32_t k) { vertices_.set_medium(k, medium_at(k)); });
        }
    }
    std::uint32_t medium_at(std::uint32_t k) const requires(kTracksMedium<F>) {
        return paths_.rows.beside(path(k)).medium;
    }

    /// Plays roulette at the vertices. Returns the paths that go on.
    std::uint64_t continue_paths(std::uint64_t reached) {
        const float* estimates = Hookless<M> ? nullptr : estimates_;
        if constexpr (LaneLearning<M>) estimates = learning_.estimate(reached);
        BlockBits survivors;
        paths_.kernels.play_roulette(paths_.setup.path, block_, estimates, survivors);
        const std::uint64_t continuing = survivors.bits() & reached;
        if constexpr (kTellsChains<F, M>)
            for_bits(continuing & specular_, [&](std::uint32_t k) {
                paths_.rows.beside(path(k)).chain.weight *= group(k).roulette_weight[k % kGroupSize];
            });
        return continuing;
    }

    void add_directions(std::uint64_t vertices) {
        directions_.clear();
        for_bits(vertices, [&](std::uint32_t k) {
            directions_.add(k, surface_at(k), vertices_.vertex(k), scatter_uniforms_of(k));
        });
        directions_.complete(vertices_);
    }
    ScatterUniforms scatter_uniforms_of(std::uint32_t k) const {
        const UniformBatch& uniforms = paths_.rows.uniforms;
        return {.rng = path_rng(paths_.setup.path, uniforms.pixel(path(k)), uniforms.sample(path(k))),
                .index = block_.counters[k / kGroupSize].vertex[k % kGroupSize] - 1,
                .u = block_.scatter[k / kGroupSize].get(k % kGroupSize)};
    }

    /// Samples and weighs the lights of the vertices, and packs their shadow rays.
    void request_lights(std::uint64_t reached, Shadows<F, M>& shadows) {
        lights_.sample(vertices_);
        directions_.weigh_lights(vertices_, lights_.groups());
        lights_.weigh(vertices_, directions_.groups());
        if constexpr (F.has_any(kLobeFeatures))
            for_bits(reached & vertices_.layered(), [&](std::uint32_t k) { weigh_layered(k); });
        shadows.pack(first_, block_, vertices_, lights_, reached);
    }
    void weigh_layered(std::uint32_t k) {
        const ScatterPoint<F, M>& from = vertices_.layered(k);
        ReceivedWeights weights{.throughput = vertices_.throughput(k)};
        if constexpr (kTellsChains<F, M>) weights.chain = paths_.rows.beside(path(k)).chain.weight;
        if constexpr (kTracksMedium<F>) weights.medium = medium_at(k);
        const UnweightedLight light = lights_.sample_layered(vertices_, k, weights);
        float weight = 0.0f;
        if (light.pdf_sa > 0.0f)
            weight = balance_weight(light.pdf_sa, scatter_pdf_sa(paths_.method, from, light.wi)) / light.pdf_sa;
        lights_.set_layered(k, light, weight);
    }

    /// Returns the paths that go on into a new direction.
    std::uint64_t scatter(std::uint64_t continuing) {
        directions_.sample(vertices_);
        const std::uint64_t at_lambert = continuing & ~vertices_.layered();
        BlockBits lit;
        lit.set(at_lambert);
        paths_.kernels.scatter_paths(block_, directions_.groups(),
                                     paths_.rows.rays.ray_groups() + first_ / kGroupSize, lit);
        std::uint64_t going_on = lit.bits();
        const std::uint64_t black = at_lambert & ~going_on;
        paths_.counters.path.zero_directions += static_cast<std::uint64_t>(std::popcount(black));
        ended_ |= black;
        leave_lambert(going_on);
        if constexpr (F.has_any(kLobeFeatures))
            for_bits(continuing & vertices_.layered(), [&](std::uint32_t k) {
                if (scatter_layered_at(k) == PathStatus::Continues) going_on |= std::uint64_t{1} << k;
            });
        return going_on;
    }
    /// Paths leave Lambert reflectors.
    void leave_lambert(std::uint64_t going_on) {
        if constexpr (LaneLearning<M>) learning_.scattered(directions_.groups(), going_on);
        if constexpr (LaneLearning<M> && kTellsChains<F, M>)
            for_bits(going_on & single_, [&](std::uint32_t k) { paths_.rows.beside(path(k)).chain = {}; });
        if constexpr (!kHooksInLanes<M>) for_bits(going_on, [&](std::uint32_t k) { leave(k); });
        if constexpr (learns_lights<F, M>) {
            if (!paths_.setup.scene.light_tree.empty())
                for_bits(going_on, [&](std::uint32_t k) {
                    paths_.rows.beside(path(k)).lights = learned_lights<F>(paths_.method, vertices_.vertex(k));
                });
        }
    }
    void leave(std::uint32_t k) {
        const std::uint32_t lane = k % kGroupSize;
        leave_vertex(paths_.method, vertices_.vertex(k),
                     {group(k).roulette_weight[lane] * group(k).weight.get(lane), vertices_.albedo(k),
                      directions_.groups()[k / kGroupSize].get(lane)},
                     paths_.rows.beside(path(k)), paths_.counters.path);
    }
    PathStatus scatter_layered_at(std::uint32_t k) {
        ScatterPoint<F, M>& from = vertices_.layered(k);
        from.roulette_weight = group(k).roulette_weight[k % kGroupSize];
        typename M::Sample sample{};
        State local;
        State& state = paths_.rows.read_between(path(k), local);
        const PathStatus status =
            scatter_layered(paths_.method, from, scatter_uniforms_of(k), state, paths_.output(sample));
        paths_.guided.record(sample);
        if (status == PathStatus::Continues) paths_.rows.send(path(k), state);
        return status;
    }

    Paths<F, M>& paths_;
    std::uint32_t first_ = 0;  ///< path of the block
    BlockRows block_{};
    std::uint64_t specular_ = 0;  ///< paths at specular surfaces
    std::uint64_t single_ = 0;    ///< paths whose observations are made path by path
    std::uint64_t ended_ = 0;     ///< paths that end at a vertex, not by roulette or a layered vertex
    VertexBlock<F, M> vertices_;
    SurfaceBlock surfaces_;        ///< unless the method looks volumes up ahead
    float estimates_[kPathBlock];  ///< of contributions
    SingleSurfaces<F> singles_{paths_.setup.scene};
    [[no_unique_address]] MemberIf<F.has(Feature::NextEventEstimation), LightBlock<F, M>> lights_{
        paths_.context, paths_.setup.lights};
    [[no_unique_address]] MemberIf<F.has(Feature::ManyLights), LightHits<F, M>> light_hits_{
        paths_.context, paths_.setup.lights, paths_.setup.batch_paths};
    DirectionBlock<F, M> directions_{paths_.method};
    [[no_unique_address]] MemberIf<LaneLearning<M>, TableLearning<F, M>> learning_{paths_};
};

}  // namespace pl
