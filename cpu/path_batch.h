// The main loop on the CPU for surfaces of any kind: each thread advances a batch of paths, one stage at a time for all of them, so that
// the intersector always has full vectors. The radiance of a path depends only on its number; batch size, threads and chunks affect
// speed only.
#pragma once

#include <cstdint>
#include <new>
#include <vector>

#include "core/kernel/integrator/steps.h"
#include "cpu/direction_block.h"
#include "cpu/guided_memory.h"
#include "cpu/light_block.h"
#include "cpu/light_hits.h"
#include "cpu/pass_setup.h"
#include "cpu/ray_batch.h"
#include "cpu/solid_hits.h"
#include "cpu/vertex_block.h"

namespace pl {

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
          solid_hits_(setup.scene, intersector, setup.batch_paths), guided_(method_, shared) {}

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
        guided_.flush();
        return counters_;
    }

private:
    static constexpr bool kSamplesLights = F.has(Feature::NextEventEstimation);

    [[gnu::flatten, gnu::noinline]] void fill(PathSource& source) {
        while (active_ < setup_.batch_paths && start(source, active_)) ++active_;
    }

    /// Starts the next path of the source in slot i. Returns false if the source is empty.
    PL_INLINE bool start(PathSource& source, std::uint32_t i) {
        PathStart next;
        if (!source.next(next)) return false;
        // Constructed in place: the wide loads of a copy would stall, since narrower stores do not forward to them.
        ::new (static_cast<void*>(&states_[i])) PathState<F, M>(work_.begin(next));
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
        if constexpr (F.has(Feature::ManyLights)) {
            if (light_hits_.wanted()) light_hits_.find(rays_, states_, active_);
        }
        const auto end_of = [this](std::uint32_t first) { return std::min(first + kPathBlock, active_); };
        const bool looks_ahead = TableGuided<M> && can_look_ahead();
        if constexpr (TableGuided<M>) {
            if (looks_ahead) begin_lookups(0, 0, end_of(0));
        }
        for (std::uint32_t first = 0; first < active_; first += kPathBlock) {
            const std::uint32_t next = end_of(first);
            if constexpr (TableGuided<M>) {
                if (looks_ahead) {
                    begin_lookups(first + kPathBlock, next, end_of(next));
                    lookups_of(first).finish(setup_.scene, method_.field);
                }
            }
            extend_block(first, next);
        }
    }

    /// Points of instances are made, and their volumes found, path by path.
    bool can_look_ahead() const {
        if constexpr (F.has(Feature::Instances))
            return setup_.scene.instances.empty();
        else
            return true;
    }
    /// Begins the lookups of paths [begin, end) of the block of path `first`.
    void begin_lookups(std::uint32_t first, std::uint32_t begin, std::uint32_t end) {
        lookups_of(first).begin(setup_.scene, method_.field, rays_, begin, end);
    }
    /// The lookups of the block of path i, while those of the next one are under way.
    auto& lookups_of(std::uint32_t i) { return guided_.lookups[i / kPathBlock % 2]; }

    /// Shades and scatters paths [first, end): most of the run time of a small scene. In one loop each path is shaded up to the
    /// roulette at its vertex; lights and directions are then sampled for all vertices.
    [[gnu::flatten, gnu::noinline]] void extend_block(std::uint32_t first, std::uint32_t end) {
        vertices_.clear();
        directions_.clear();
        for (std::uint32_t i = first; i < end; ++i) shade(i);
        directions_.complete(vertices_);
        if constexpr (kSamplesLights) {
            if (samples_lights()) request_lights();
        }
        scatter_vertices();
    }

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
        PathBatch& batch;
        std::uint32_t i;
        const Hit& hit;

        void find(SurfacePoint& surface) const {
            ::new (static_cast<void*>(&surface)) SurfacePoint(batch.surface_at(i, hit));  // in place, as in start()
        }
        float light_pdf_area(const SurfacePoint& surface) const {
            if constexpr (F.has(Feature::ManyLights)) {
                if (batch.light_hits_.wanted()) return batch.light_hits_.pdf_area(i, hit.primitive);
            }
            return SurfaceAhead<F, M>{batch.setup_.scene, hit, batch.states_[i]}.light_pdf_area(surface);
        }
    };

    bool samples_lights() const { return kSamplesLights && setup_.path.next_event != 0; }

    void shade(std::uint32_t i) {
        typename M::Sample sample{};
        const StepOutput<M> out{sample, counters_.path};
        const Hit hit = rays_.hit(i);
        VertexSlot slot;
        ScatterPoint<F, M>& from = slot.in(vertices_);
        statuses_[i] = shade_hit<F, M>(context_, hit, Ahead{*this, i, hit}, states_[i], {out, from});
        if (statuses_[i] == PathStatus::Continues) statuses_[i] = leave(i, hit, from, out);
        guided_.record(sample);
    }

    SurfacePoint surface_at(std::uint32_t i, const Hit& hit) {
        if constexpr (TableGuided<M>) {
            method_.is_found = false;
            if (can_look_ahead()) {
                const LookupsAhead& lookups = lookups_of(i);
                method_.is_found = lookups.is_found(i);
                method_.found = lookups.found(i);
                return lookups.template surface<F>(setup_.scene, hit, i);
            }
        }
        return make_surface_point<F>(setup_.scene, hit, -states_[i].ray.direction);
    }

    /// Plays roulette at the vertex `from` of path i. Its light and its direction are left to the block.
    PathStatus leave(std::uint32_t i, const Hit& hit, ScatterPoint<F, M>& from, const StepOutput<M>& out) {
        const VertexNumbers numbers = numbers_.numbers(i);
        if (samples_lights()) add_vertex(i, from, numbers);
        const PathStatus status = continue_path(context_, hit, numbers.scatter.w, states_[i], from, out);
        if (status == PathStatus::Finished) return status;
        if (!samples_lights()) add_vertex(i, from, numbers);
        vertices_.keep_last(from.roulette_weight);
        return status;
    }
    void add_vertex(std::uint32_t i, const ScatterPoint<F, M>& from, const VertexNumbers& numbers) {
        vertices_.add(i, from, received_weights(states_[i]), numbers);
        directions_.add(vertices_, vertices_.count() - 1, from,
                        scatter_numbers(setup_.path, states_[i], numbers.scatter));
    }

    /// Samples and weighs the lights of the block's vertices.
    void request_lights() {
        lights_.sample(vertices_);
        directions_.weigh_lights(vertices_, lights_.groups());
        lights_.weigh(vertices_, directions_.groups());
        for (std::uint32_t k = 0; k < vertices_.count(); ++k) request_light_of(k);
    }
    void request_light_of(std::uint32_t k) {
        const std::uint32_t path = vertices_.path(k);
        if constexpr (F.has_any(kLobeFeatures)) {
            if (vertices_.is_layered(k)) return request_layered(k, path);
        }
        const bool wanted = lights_.is_wanted(k);
        const Vec3f chain = received_weights(states_[path]).chain;
        const typename M::Light light = method_.light_sampled(states_[path].memory, vertices_.vertex(k),
                                                              wanted ? lights_.estimate(k, chain) : LightEstimate{});
        if (!wanted) return guided_.record_light(light, false);
        ShadowRequest<M>& shadow = add_shadow_ray(path, lights_.shadow_ray(k, vertices_.primitive(k)));
        shadow.contribution = lights_.contribution(k);
        shadow.light = light;
    }
    void request_layered(std::uint32_t k, std::uint32_t path) {
        ShadowRequest<M> shadow;
        weigh_light(method_, vertices_.layered(k), lights_.sample_layered(vertices_, k), states_[path], shadow);
        if (!shadow.wanted) return guided_.record_light(shadow.light, false);
        add_shadow_ray(path, shadow.ray) = shadow;
    }
    ShadowRequest<M>& add_shadow_ray(std::uint32_t path, const Ray& ray) {
        shadow_rays_.set_ray(shadow_count_, ray);
        shadow_paths_[shadow_count_] = path;
        return shadows_[shadow_count_++];
    }

    /// Scatters the paths that continue from the block's vertices.
    void scatter_vertices() {
        directions_.sample(vertices_);
        kernels_.scatter(vertices_.groups(), directions_.groups(), scattered_, vertices_.group_count());
        vertices_.for_continuing([this](std::uint32_t k) {
            const std::uint32_t path = vertices_.path(k);
            statuses_[path] = scatter_vertex(k, path);
        });
    }
    PathStatus scatter_vertex(std::uint32_t k, std::uint32_t path) {
        if constexpr (F.has_any(kLobeFeatures)) {
            if (vertices_.is_layered(k)) return scatter_alone(k, path);
        }
        PathState<F, M>& state = states_[path];
        const std::uint32_t lane = k % kGroupSize;
        const ScatteredGroup& to = scattered_[k / kGroupSize];
        if (to.is_lit[lane] == 0) {
            typename M::Sample none{};
            return terminate_black(method_, state, StepOutput<M>{none, counters_.path});
        }
        const DirectionSample direction = directions_.groups()[k / kGroupSize].get(lane);
        const Vec3f weight = to.weight.get(lane);
        state.throughput *= weight;
        state.ray = {.origin = to.origin.get(lane), .direction = direction.wi, .source = vertices_.primitive(k)};
        state.direction_pdf_sa = direction.pdf_sa;
        state.lights = learned_lights<F>(method_, vertices_.vertex(k));
        leave_vertex(method_, vertices_.vertex(k),
                     {vertices_.roulette_weight(k) * weight, vertices_.albedo(k), direction}, state, counters_.path);
        return PathStatus::Continues;
    }
    /// Scatters a path at a layered vertex.
    PathStatus scatter_alone(std::uint32_t k, std::uint32_t path) {
        typename M::Sample sample{};
        const ScatterNumbers numbers = scatter_numbers(setup_.path, states_[path], numbers_.numbers(path).scatter);
        const PathStatus status = scatter_layered(method_, vertices_.layered(k), numbers, states_[path],
                                                  StepOutput<M>{sample, counters_.path});
        guided_.record(sample);
        return status;
    }

    [[gnu::flatten, gnu::noinline]] void connect() {
        find_blocked();
        for (std::uint32_t i = 0; i < shadow_count_; ++i) {
            const bool is_visible = !shadow_rays_.occluded(i);
            if (is_visible) connect_light(method_, shadows_[i], states_[shadow_paths_[i]], counters_.path);
            guided_.record_light(shadows_[i].light, is_visible);
        }
        counters_.path.shadow_rays += shadow_count_;
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
    LaneKernels kernels_ = best_lane_kernels();
    VertexBlock<F, M> vertices_;
    [[no_unique_address]] LightBlock<F, M> lights_{context_, setup_.lights};
    [[no_unique_address]] LightHits<F, M> light_hits_{context_, setup_.lights, setup_.batch_paths};
    DirectionBlock<F, M> directions_{method_};
    ScatteredGroup scattered_[kBlockGroups];
    GuidedMemory<M> guided_;
    std::uint32_t active_ = 0;
    std::uint32_t shadow_count_ = 0;
    PassCounters counters_;
};

}  // namespace pl
