// The vertices of a block of paths that have a PathState each: from hits to the next rays. Lights and directions are found in SIMD lanes,
// and volumes with their surface points; the rest is done path by path.
#pragma once

#include "core/kernel/integrator/steps.h"
#include "cpu/paths/direction_block.h"
#include "cpu/paths/light_block.h"
#include "cpu/paths/state_paths.h"
#include "cpu/paths/vertex_block.h"

namespace pl {

template <FeatureSet F, Method M>
class StateVertices {
public:
    explicit StateVertices(StatePaths<F, M>& paths) : paths_(paths) {}

    /// Call once before extend() is called for the blocks of the first `active` paths.
    void begin([[maybe_unused]] std::uint32_t active) {
        if constexpr (F.has(Feature::ManyLights)) {
            if (light_hits_.wanted())
                light_hits_.find(
                    paths_.rays(), active, [this](std::uint32_t i) -> auto& { return paths_.state(i); });
        }
    }
    /// Shades and scatters the `count` paths from `first` on, a multiple of kPathBlock: most of the run time of a small scene. In one loop
    /// each path is shaded up to the roulette at its vertex; lights and directions are then sampled for all vertices. Returns the
    /// paths that have ended, one bit each.
    [[gnu::flatten, gnu::noinline]] std::uint64_t extend(std::uint32_t first, std::uint32_t count,
                                                         StateShadows<F, M>& shadows) {
        first_ = first;
        vertices_.clear();
        directions_.clear();
        for (std::uint32_t i = first; i < first + count; ++i) shade(i);
        directions_.complete(vertices_);
        if constexpr (F.has(Feature::NextEventEstimation)) {
            if (paths_.samples_lights()) request_lights(shadows);
        }
        return first_bits(count) & ~scatter();
    }

private:
    using State = PathState<F, M>;

    /// Place of the vertex that a path reaches: on the stack unless it may stay in the block.
    struct VertexSlot {
        [[no_unique_address]] std::conditional_t<F.has_any(kLobeFeatures), Nothing, ScatterPoint<F, M>> point;

        ScatterPoint<F, M>& in(VertexBlock<F, M>& vertices) {
            if constexpr (F.has_any(kLobeFeatures))
                return vertices.next_layered();
            else
                return point;
        }
    };

    /// The surface that path i has hit, see SurfaceAhead.
    struct Ahead {
        StateVertices& vertices;
        std::uint32_t i;
        const Hit& hit;

        void find(SurfacePoint& surface) const {
            ::new (static_cast<void*>(&surface))
                SurfacePoint(vertices.surface_at(i, hit));  // see StatePaths::start()
        }
        float light_pdf_area(const SurfacePoint& surface) const {
            if constexpr (F.has(Feature::ManyLights)) {
                if (vertices.light_hits_.wanted()) return vertices.light_hits_.pdf_area(i, hit.primitive);
            }
            StatePaths<F, M>& paths = vertices.paths_;
            return SurfaceAhead<F, M>{paths.setup.scene, hit, paths.state(i)}.light_pdf_area(surface);
        }
    };

    void shade(std::uint32_t i) {
        typename M::Sample sample{};
        const StepOutput<M> out = paths_.output(sample);
        const Hit hit = paths_.rays().hit(i);
        VertexSlot slot;
        ScatterPoint<F, M>& from = slot.in(vertices_);
        if (shade_hit<F, M>(paths_.context, hit, Ahead{*this, i, hit}, paths_.state(i), {out, from}) ==
            PathStatus::Continues)
            leave(i, from, out);
        paths_.guided.record(sample);
    }

    SurfacePoint surface_at(std::uint32_t i, const Hit& hit) {
        const SceneView& scene = paths_.setup.scene;
        if constexpr (TableGuided<M>) {
            paths_.method.is_found = false;
            if (paths_.can_look_ahead()) {
                const LookupsAhead& lookups = paths_.lookups_of(i);
                paths_.method.is_found = lookups.is_found(i);
                paths_.method.found = lookups.found(i);
                return lookups.surfaces().template surface<F>(scene, hit, i);
            }
        }
        return make_surface_point<F>(scene, hit, -paths_.state(i).ray.direction);
    }

    /// Plays roulette at the vertex `from` of path i. Its light and its direction are left to the block.
    void leave(std::uint32_t i, ScatterPoint<F, M>& from, const StepOutput<M>& out) {
        const VertexUniforms uniforms = paths_.uniforms().uniforms(i);
        if (paths_.samples_lights()) add_vertex(i, from, uniforms);
        if (continue_path(paths_.context, uniforms.scatter.w, paths_.state(i), from, out) == PathStatus::Finished)
            return;
        if (!paths_.samples_lights()) add_vertex(i, from, uniforms);
        vertices_.keep_last(from.roulette_weight);
    }
    void add_vertex(std::uint32_t i, const ScatterPoint<F, M>& from, const VertexUniforms& uniforms) {
        const State& state = paths_.state(i);
        vertices_.add(i, from, received_weights(state), uniforms);
        directions_.add(vertices_, vertices_.count() - 1, from,
                        scatter_uniforms(paths_.setup.path, state, uniforms.scatter));
    }

    /// Samples and weighs the lights of the block's vertices.
    void request_lights(StateShadows<F, M>& shadows) {
        lights_.sample(vertices_);
        directions_.weigh_lights(vertices_, lights_.groups());
        lights_.weigh(vertices_, directions_.groups());
        for (std::uint32_t k = 0; k < vertices_.count(); ++k) request_light(k, shadows);
    }
    void request_light(std::uint32_t k, StateShadows<F, M>& shadows) {
        const std::uint32_t path = vertices_.path(k);
        if constexpr (F.has_any(kLobeFeatures)) {
            if (vertices_.is_layered(k)) return request_layered(k, path, shadows);
        }
        const bool wanted = lights_.is_wanted(k);
        State& state = paths_.state(path);
        const typename M::Light light = paths_.method.light_sampled(
            state.memory, vertices_.vertex(k),
            wanted ? lights_.estimate(k, received_weights(state).chain) : LightEstimate{});
        if (!wanted) return paths_.guided.record_light(light, false);
        ShadowRequest<M>& shadow = shadows.add(path, lights_.shadow_ray(k, vertices_.primitive(k)));
        shadow.contribution = lights_.contribution(k);
        shadow.light = light;
    }
    void request_layered(std::uint32_t k, std::uint32_t path, StateShadows<F, M>& shadows) {
        ShadowRequest<M> shadow;
        weigh_light(paths_.method, vertices_.layered(k), lights_.sample_layered(vertices_, k), paths_.state(path),
                    shadow);
        if (!shadow.wanted) return paths_.guided.record_light(shadow.light, false);
        shadows.add(path, shadow.ray) = shadow;
    }

    /// Scatters the paths that continue from the block's vertices. Returns those that go on into a new direction.
    std::uint64_t scatter() {
        directions_.sample(vertices_);
        paths_.kernels.scatter(vertices_.groups(), directions_.groups(), scattered_, vertices_.group_count());
        std::uint64_t going_on = 0;
        vertices_.for_continuing([&](std::uint32_t k) {
            const std::uint32_t path = vertices_.path(k);
            if (scatter(k, path) == PathStatus::Finished) return;
            going_on |= std::uint64_t{1} << (path - first_);
            paths_.send(path);
        });
        return going_on;
    }
    PathStatus scatter(std::uint32_t k, std::uint32_t path) {
        if constexpr (F.has_any(kLobeFeatures)) {
            if (vertices_.is_layered(k)) return scatter_alone(k, path);
        }
        State& state = paths_.state(path);
        const std::uint32_t lane = k % kGroupSize;
        const ScatteredGroup& to = scattered_[k / kGroupSize];
        if (to.is_lit[lane] == 0) {
            typename M::Sample none{};
            return terminate_black(paths_.method, state, paths_.output(none));
        }
        const DirectionSample direction = directions_.groups()[k / kGroupSize].get(lane);
        const Vec3f weight = to.weight.get(lane);
        state.throughput *= weight;
        state.ray = {.origin = to.origin.get(lane), .direction = direction.wi, .source = vertices_.primitive(k)};
        state.direction_pdf_sa = direction.pdf_sa;
        state.lights = learned_lights<F>(paths_.method, vertices_.vertex(k));
        leave_vertex(paths_.method, vertices_.vertex(k),
                     {vertices_.roulette_weight(k) * weight, vertices_.albedo(k), direction}, state,
                     paths_.counters.path);
        return PathStatus::Continues;
    }
    /// Scatters a path at a layered vertex.
    PathStatus scatter_alone(std::uint32_t k, std::uint32_t path) {
        typename M::Sample sample{};
        State& state = paths_.state(path);
        const ScatterUniforms uniforms =
            scatter_uniforms(paths_.setup.path, state, paths_.uniforms().uniforms(path).scatter);
        const PathStatus status =
            scatter_layered(paths_.method, vertices_.layered(k), uniforms, state, paths_.output(sample));
        paths_.guided.record(sample);
        return status;
    }

    StatePaths<F, M>& paths_;
    std::uint32_t first_ = 0;  ///< path of the block
    VertexBlock<F, M> vertices_;
    [[no_unique_address]] LightBlock<F, M> lights_{paths_.context, paths_.setup.lights};
    [[no_unique_address]] LightHits<F, M> light_hits_{paths_.context, paths_.setup.lights, paths_.setup.batch_paths};
    DirectionBlock<F, M> directions_{paths_.method};
    ScatteredGroup scattered_[kBlockGroups];
};

}  // namespace pl
