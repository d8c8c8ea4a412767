#include "core/diagnose/batch_tracer.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/kernel/geometry/intersector.h"
#include "core/kernel/integrator/sampled_lights.h"
#include "core/kernel/integrator/trace_path.h"
#include "core/kernel/methods/default.h"

namespace pl::diagnose {
namespace {

/// The kernel of all effects.
constexpr FeatureSet kAll = kEveryFeature;

/// A method whose directions and densities are known before the integrator asks for them, since Python answers for many vertices at once.
struct AnsweredMethod : MethodHooks {
    struct Vertex {
        DirectionSample direction;
    };

    Vertex locate(const SurfacePoint&, MethodCounters&) const { return {}; }

    DirectionSample sample_direction(const Vertex& vertex, const SurfacePoint&, const ScatterUniforms&) const {
        return vertex.direction;
    }
    float pdf_sa(const Vertex& vertex, const SurfacePoint&, Vec3f) const { return vertex.direction.pdf_sa; }
    template <FeatureSet B>
    DirectionSample sample_direction(const Vertex& vertex, const SurfacePoint&, const LayeredBsdf<B>&,
                                     const ScatterUniforms&) const {
        return vertex.direction;
    }
    template <FeatureSet B>
    float pdf_sa(const Vertex& vertex, const SurfacePoint&, const LayeredBsdf<B>&, Vec3f) const {
        return vertex.direction.pdf_sa;
    }
};

using Context = PathContext<AnsweredMethod>;

/// A path, and the vertex at the end of its segment.
struct TracedPath {
    PathState<kAll, AnsweredMethod> state;
    SegmentEnd<kAll, AnsweredMethod> end;
    UnweightedLight light;  ///< sampled there
    PathStatus status = PathStatus::Continues;
    PathCounters counters;

    /// Density of the BSDF without its delta lobes.
    float bsdf_pdf(Vec3f wi) const {
        return end.from.bsdf.is_lambert() ? lambert_pdf_sa(end.from.surface, wi)
                                          : end.from.bsdf.pdf_sa(end.from.surface, wi);
    }
};

/// Traces the path's segment, and samples a light at its end.
void extend(const Context& context, TracedPath& path) {
    path.end = {};
    path.light = {};
    const Hit hit = closest_solid_hit<kAll>(context.scene, BvhIntersector{context.scene}, path.state.ray);
    path.status = shade_segment<kAll>(context, hit, path.state, path.end, path.counters);
    if (path.status == PathStatus::Continues && context.settings.next_event != 0)
        path.light = sample_light(context, path.end.from, path.end.uniforms.light, received_weights(path.state));
}

/// Continues the path from the end of its segment. `light_pdf`: density of the directions of sampler and BSDF towards its light.
void leave(const Context& context, float light_pdf, TracedPath& path) {
    const auto& from = path.end.from;
    ShadowRequest<AnsweredMethod> shadow;
    weigh_light<kAll>(context.method, from.vertex, path.light, (1.0f - from.bsdf.delta_probability()) * light_pdf,
                      path.state, shadow);
    path.status = continue_path<kAll, AnsweredMethod>(context, path.end.uniforms.scatter.w, path.state, path.end.from,
                                                      {path.end.sample, path.counters});
    path.status = scatter_at_end<kAll>(context, path.status, path.end, path.state, path.counters);
    path.status =
        connect_segment<kAll>(context, BvhIntersector{context.scene}, shadow, path.status, path.state, path.counters);
}

PathVertex vertex_of(const TracedPath& path) {
    const auto& [uniforms, from, sample] = path.end;
    return {.pixel = path.state.pixel,
            .sample = path.state.sample,
            .depth = path.state.vertices - 1,
            .position = from.surface.position,
            .normal = from.surface.shading_normal,
            .outgoing = -path.state.ray.direction,
            .albedo = from.bsdf.albedo(),
            .uniforms = {uniforms.scatter.y, uniforms.scatter.z},
            .throughput = path.state.throughput};
}

/// Calls body(i) for the indices below `count`.
template <class Body>
void for_paths(std::size_t count, Body&& body) {
    constexpr std::uint32_t kPathChunk = 64;
    for_chunks(static_cast<std::uint32_t>(count), kPathChunk, usable_threads(), [&](IndexRange range) {
        for (std::uint32_t i = range.begin; i < range.end; ++i) body(i);
    });
}

/// The direction that the BSDF samples at the end of the path's segment, without its delta lobes.
Vec3f bsdf_direction(const PathSettings& settings, const TracedPath& path) {
    const auto& [uniforms, from, sample] = path.end;
    const Vec2f u{uniforms.scatter.y, uniforms.scatter.z};
    if (from.bsdf.is_lambert()) return lambert_sample(from.surface, u);
    const Rng rng = path_rng(settings, path.state.pixel, path.state.sample);
    return from.bsdf.sample(from.surface, u, rng.draw(path.state.vertices, Purpose::Lobe).z);
}

/// What a vertex, and the path behind it, is worth once the path has ended.
struct Departure {
    std::uint32_t path = 0;
    Vec3f radiance{0.0f};  ///< of the path's estimator so far
    Vec3f throughput{0.0f};
};

/// The mean over the rest of a path of what arrives from a departure's direction. Channels that the path no longer carries are 0.
Vec3f incident_along(const Departure& departure, Vec3f radiance) {
    Vec3f incident{0.0f};
    for (int c = 0; c < 3; ++c)
        if (departure.throughput[c] > 0.0f)
            incident[c] = (radiance[c] - departure.radiance[c]) / departure.throughput[c];
    return incident;
}

/// Directions at the vertices of a batch, and their densities.
struct Answers {
    std::vector<Vec3f> directions;
    std::vector<float> pdf;  ///< of the sampler; empty without one
    /// Of the sampler, towards the light samples: empty without light samples; not read at vertices without one.
    std::vector<float> light_pdf;
    float bsdf_fraction = 1.0f;

    float mixed(float bsdf_pdf, const std::vector<float>& sampler_pdf, std::uint32_t i) const {
        return sampler_pdf.empty() ? bsdf_pdf : bsdf_fraction * bsdf_pdf + (1.0f - bsdf_fraction) * sampler_pdf[i];
    }
};

Answers ask(const DirectionSampler* sampler, const PathSettings& settings, std::span<const PathVertex> vertices,
            const std::vector<TracedPath>& paths, const std::vector<std::uint32_t>& active) {
    Answers answers;
    for (const std::uint32_t i : active) answers.directions.push_back(bsdf_direction(settings, paths[i]));
    if (sampler == nullptr) return answers;
    answers.bsdf_fraction = sampler->bsdf_fraction;
    const std::vector<Vec3f> sampled = sampler->sample(vertices);
    std::vector<Vec3f> to_lights = sampled;
    for (std::size_t i = 0; i < active.size(); ++i) {
        const TracedPath& path = paths[active[i]];
        if (!(path.end.uniforms.scatter.x < sampler->bsdf_fraction)) answers.directions[i] = sampled[i];
        if (path.light.pdf_sa > 0.0f) to_lights[i] = path.light.wi;
    }
    answers.pdf = sampler->pdf(vertices, answers.directions);
    for (std::size_t i = 0; i < active.size(); ++i)
        if (answers.pdf[i] == 0.0f && answers.directions[i] == sampled[i])
            throw Error(ErrorKind::Input,
                        fmt::format("sampler, vertex {} of pixel {}: expected a density above 0 of the "
                                    "direction that it sampled, got 0",
                                    i, vertices[i].pixel));
    if (settings.next_event != 0) answers.light_pdf = sampler->pdf(vertices, to_lights);
    return answers;
}

void drop_finished(std::vector<std::uint32_t>& active, const std::vector<TracedPath>& paths) {
    std::erase_if(active, [&](std::uint32_t i) { return paths[i].status == PathStatus::Finished; });
}

}  // namespace

BatchTracer::BatchTracer(std::shared_ptr<const HostScene> scene, const Camera& camera, int width, int height,
                         const PathSettings& path)
    : scene_(std::move(scene)), camera_(camera), width_(width), height_(height), path_(path),
      film_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

std::vector<PathVertex> BatchTracer::trace() { return trace_pass(path_, nullptr); }

std::vector<PathVertex> BatchTracer::trace(const DirectionSampler& sampler) {
    PathSettings path = path_;
    path.sequences = {.name = 2 * passes_, .first_sample = passes_};
    return trace_pass(path, &sampler);
}

std::vector<PathVertex> BatchTracer::trace_pass(const PathSettings& settings, const DirectionSampler* sampler) {
    const SampledScene sampled = with_delta_lights(scene_->view(), settings);
    const AnsweredMethod method;
    const Context context{sampled.scene, method, sampled.path};
    const PixelGrid grid{static_cast<std::uint32_t>(width_), static_cast<std::uint32_t>(height_), passes_};
    std::vector<TracedPath> paths(film_.size());
    std::vector<std::uint32_t> active(film_.size());
    for (std::uint32_t i = 0; i < active.size(); ++i) {
        paths[i].state = begin_path<kAll, AnsweredMethod>(camera_, sampled.path, grid, i);
        active[i] = i;
    }
    std::vector<PathVertex> vertices;
    std::vector<Departure> departures;
    for (;;) {
        for_paths(active.size(), [&](std::uint32_t i) { extend(context, paths[active[i]]); });
        drop_finished(active, paths);
        if (active.empty()) break;
        std::vector<PathVertex> batch;
        for (const std::uint32_t i : active) batch.push_back(vertex_of(paths[i]));
        const Answers answers = ask(sampler, sampled.path, batch, paths, active);
        for_paths(active.size(), [&](std::uint32_t i) {
            TracedPath& path = paths[active[i]];
            const Vec3f wi = answers.directions[i];
            const float bsdf_pdf = path.bsdf_pdf(wi);
            path.end.from.vertex.direction = {wi, answers.mixed(bsdf_pdf, answers.pdf, i), bsdf_pdf};
            const bool has_light = path.light.pdf_sa > 0.0f;
            leave(context, has_light ? answers.mixed(path.bsdf_pdf(path.light.wi), answers.light_pdf, i) : 0.0f,
                  path);
            if (path.status == PathStatus::Finished) return;
            batch[i].direction = path.state.ray.direction;
            batch[i].pdf = path.state.direction_pdf_sa;
        });
        for (const std::uint32_t i : active) {
            const bool ends = paths[i].status == PathStatus::Finished;
            departures.push_back({i, paths[i].state.radiance, ends ? Vec3f{0.0f} : paths[i].state.throughput});
        }
        vertices.insert(vertices.end(), batch.begin(), batch.end());
        drop_finished(active, paths);
    }
    for (std::size_t i = 0; i < departures.size(); ++i)
        vertices[i].incident = incident_along(departures[i], paths[departures[i].path].state.radiance);
    const FilmView film{.pixels = Span<FilmPixel>(film_.data(), static_cast<std::uint32_t>(film_.size())),
                        .width = grid.width,
                        .height = grid.height};
    for (std::uint32_t i = 0; i < film_.size(); ++i) accumulate(film, i, paths[i].state.radiance, passes_);
    ++passes_;
    return vertices;
}

}  // namespace pl::diagnose
