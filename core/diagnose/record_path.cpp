#include "core/diagnose/record_path.h"

#include "core/diagnose/observed_method.h"
#include "core/diagnose/replay_path.h"
#include "core/kernel/geometry/intersector.h"
#include "core/kernel/integrator/sampled_lights.h"
#include "core/kernel/integrator/trace_path.h"

namespace pl::diagnose {

namespace {

/// The kernel of all features traces the same bits as the one that rendered the pass.
constexpr FeatureSet kAll = kEveryFeature;

/// Traces a path segment by segment. The state before a segment and the kernel's functions give the vertex at its end; the state
/// behind it, the direction that follows.
template <Method M>
class PathRecorder {
public:
    using State = PathState<kAll, M>;

    /// `choices`: the choices that the method notes.
    PathRecorder(const PathContext<M>& context, ObservedChoices& choices)
        : scene_(context.scene), method_(context.method), context_(context), choices_(choices) {}

    PathRecord run(State& state) {
        PathRecord record{.pixel = state.pixel, .sample = state.sample, .eye = state.ray.origin};
        PathCounters counters;
        typename M::Store store;
        keep_store(state, &store);
        PathStatus status = PathStatus::Continues;
        while (status == PathStatus::Continues) {
            Point point;
            VertexRecord& vertex = record.vertices.emplace_back();
            const std::optional<PathEnd> end = add_vertex(state, point, vertex);
            choices_.is_light_visible = false;
            choices_.target.reset();
            status = trace_segment<kAll>(context_, BvhIntersector{scene_}, state, counters);
            see_light(vertex);
            vertex.target = choices_.target;
            if (status == PathStatus::Continues)
                vertex.scattered = direction_from(point, state);
            else
                record.end = end.value_or(PathEnd::ZeroDirection);
        }
        record.radiance = state.radiance;
        record.segments = static_cast<std::uint32_t>(counters.segments);
        record.shadow_rays = static_cast<std::uint32_t>(counters.shadow_rays);
        return record;
    }

private:
    using Point = ScatterPoint<kAll, M>;

    /// Returns the reason why the path ends at the vertex, as far as it is known before a direction is sampled.
    std::optional<PathEnd> add_vertex(const State& before, Point& point, VertexRecord& vertex) const {
        vertex.origin = before.ray.origin;
        vertex.wo = -before.ray.direction;
        const Hit hit = closest_solid_hit<kAll>(scene_, BvhIntersector{scene_}, before.ray);
        State arrived = before;
        absorb_segment(scene_, hit, arrived);
        vertex.throughput = arrived.throughput;
        if (!hit.found()) {
            vertex.is_escape = true;
            vertex.emission = environment_emission(arrived);
            return PathEnd::Escaped;
        }
        point = add_surface(hit, arrived, vertex);
        return add_interaction(point, arrived, vertex);
    }

    Point add_surface(const Hit& hit, const State& before, VertexRecord& vertex) const {
        Point point;
        point.surface = make_surface_point<kAll>(scene_, hit, vertex.wo);
        point.bsdf = make_bsdf<kAll>(scene_, point.surface, hit_weights(hit), vertex.wo);
        MethodCounters uncounted;
        if (point.bsdf.scatters() && !point.bsdf.is_specular())
            point.vertex = method_.locate(point.surface, uncounted);
        vertex.position = point.surface.position;
        vertex.geometric_normal = point.surface.geometric_normal;
        vertex.shading_normal = point.surface.shading_normal;
        vertex.distance = hit.t;
        vertex.primitive = point.surface.primitive;
        vertex.material = point.surface.material;
        vertex.albedo = point.bsdf.albedo();
        vertex.delta_probability = point.bsdf.is_lambert() ? 0.0f : point.bsdf.delta_probability();
        if constexpr (GuidedMethod<M>) {
            if (point.vertex.is_served()) {
                vertex.volume = point.vertex.volume;
                vertex.bsdf_fraction = method_.bsdf_fraction(point.vertex);
            }
        }
        vertex.emission = surface_emission(hit, point.surface, before);
        return point;
    }

    EmissionRecord surface_emission(const Hit& hit, const SurfacePoint& surface, const State& before) const {
        EmissionRecord emission{.radiance = emitted_at<kAll>(scene_, surface, hit_weights(hit))};
        if (is_black(emission.radiance)) return emission;
        State alone = before;
        alone.radiance = Vec3f{0.0f};
        emission.weight =
            add_emission(context_, SurfaceAhead<kAll, M>{scene_, hit, before}, surface, emission.radiance, alone);
        emission.contribution = alone.radiance;
        if (samples_lights(before))
            emission.light_pdf_sa =
                light_pdf_sa<kAll>(scene_, before.ray.origin, surface, before.ray.direction, learned_lights(before));
        return emission;
    }

    EmissionRecord environment_emission(const State& before) const {
        State alone = before;
        alone.radiance = Vec3f{0.0f};
        EmissionRecord emission{.radiance = add_environment(scene_, context_.settings, alone).emitted,
                                .contribution = alone.radiance};
        if (scene_.far_lights.empty() || !samples_lights(before)) return emission;
        emission.light_pdf_sa = far_light_pdf_sa(scene_, before.ray.direction);
        emission.weight = direction_weight(context_.settings, before, [&] { return emission.light_pdf_sa; });
        return emission;
    }

    bool samples_lights(const State& before) const {
        return context_.settings.next_event != 0 && before.direction_pdf_sa > 0.0f;
    }

    /// The light sample, and roulette. Returns the reason if the path ends.
    std::optional<PathEnd> add_interaction(Point& point, const State& before, VertexRecord& vertex) const {
        if (!point.bsdf.scatters()) return PathEnd::Absorbed;
        State state = before;
        if (++state.vertices >= context_.settings.max_depth) return PathEnd::DepthLimit;
        if (point.bsdf.is_specular()) count_specular(context_.settings, state);
        const VertexUniforms numbers = draw_vertex_uniforms<kAll>(context_.settings, before);
        if (context_.settings.next_event != 0) vertex.light = light_sample(point, numbers.light, before);
        const float weight =
            play_roulette(method_, context_.settings, point.vertex, point.bsdf.albedo(), numbers.scatter.w, state);
        vertex.roulette = roulette_record(weight, state);
        return vertex.roulette->survives ? std::nullopt : std::optional(PathEnd::Roulette);
    }

    std::optional<LightSampleRecord> light_sample(const Point& point, Vec4f u, const State& before) const {
        const UnweightedLight light = sample_light(context_, point, u, received_weights(before));
        if (!(light.pdf_sa > 0.0f)) return std::nullopt;
        LightSampleRecord record{.wi = light.wi, .primitive = light.ray.target, .pdf_sa = light.pdf_sa};
        if (record.primitive != kNoPrimitive)
            record.position = light.ray.origin + light.ray.t_max * light.ray.direction;
        record.scatter_pdf_sa = scatter_pdf_sa(method_, point, light.wi);
        record.weight = balance_weight(light.pdf_sa, record.scatter_pdf_sa);
        State unused = before;
        ShadowRequest<M> shadow;
        weigh_light<kAll>(method_, point.vertex, light, record.scatter_pdf_sa, unused, shadow);
        record.unoccluded = shadow.contribution;
        return record;
    }

    /// `weight`: of roulette; `after`: the state behind it.
    RouletteRecord roulette_record(float weight, const State& after) const {
        const float survival = weight > 0.0f
                                   ? 1.0f / weight
                                   : survival_probability(context_.settings, choices_.estimate, after.survival);
        return {.estimate = choices_.estimate, .survival_probability = survival, .survives = weight > 0.0f};
    }

    void see_light(VertexRecord& vertex) const {
        if (!vertex.light || !choices_.is_light_visible) return;
        vertex.light->is_visible = true;
        vertex.light->contribution = vertex.light->unoccluded;
    }

    /// The direction from a vertex that `after` goes on in.
    ScatterRecord direction_from(const Point& point, const State& after) const {
        ScatterRecord direction{
            .wi = after.ray.direction, .pdf_sa = after.direction_pdf_sa, .throughput = after.throughput};
        if (after.direction_pdf_sa > 0.0f) {
            direction.technique = choices_.samples_field ? Technique::Field : Technique::Bsdf;
            direction.bsdf_pdf_sa = choices_.direction.bsdf_pdf_sa;
            direction.bsdf_cos =
                point.bsdf.eval(point.surface, direction.wi, point.bsdf.cosine(point.surface, direction.wi));
            if constexpr (GuidedMethod<M>) {
                if (point.vertex.is_served())
                    direction.field_pdf_sa = method_.field.density(point.vertex, point.surface, direction.wi).pdf_sa;
            }
        } else {
            direction.technique = Technique::Delta;
        }
        return direction;
    }

    const SceneView& scene_;
    const M& method_;
    PathContext<M> context_;
    ObservedChoices& choices_;
};

}  // namespace

AnyFieldView field_of(PassReplay& passes) {
    if (!passes.volumes) return {};
    return field_view(passes.shape, *passes.volumes, passes.field);
}

PathRecord record_path(const PassReplay& passes, const AnyFieldView& field, std::uint32_t pixel, std::uint32_t pass) {
    const std::uint32_t sample = passes.schedule.sample_of(pass);
    const PixelGrid grid{static_cast<std::uint32_t>(passes.width), static_cast<std::uint32_t>(passes.height), sample};
    const auto trace = [&](const auto& method, const PathSettings& path) {
        using M = Observed<std::remove_cvref_t<decltype(method)>>;
        ObservedChoices choices;
        const M observed(method, choices);
        auto state = begin_path<kAll, M>(passes.camera, path, grid, pixel);
        const SampledScene sampled = with_delta_lights(passes.scene->view(), path);
        return PathRecorder<M>({sampled.scene, observed, sampled.path}, choices).run(state);
    };
    PathRecord record = with_replayed_method<ObservedGuided>(passes, field, pass, trace);
    record.is_guided = is_guided_path(passes, pass);
    const bool trains = passes.run_of(pass).trains && passes.learning.target == LearningTarget::ExpectedSarsa;
    for (VertexRecord& vertex : record.vertices)
        if (!trains) vertex.target.reset();
    return record;
}

}  // namespace pl::diagnose
