#include "tests/bench/uniform_sampling.h"

#include "core/base/parallel.h"
#include "core/kernel/integrator/trace_path.h"
#include "core/kernel/methods/default.h"
#include "core/scene/pack_scene.h"

namespace pl::benchmarks {
namespace {

constexpr float kUniformPdf = 0.5f * kInvPi;  // per steradian of the hemisphere

struct UniformMethod : DefaultMethod {
    using DefaultMethod::pdf_sa;
    using DefaultMethod::sample_direction;

    DirectionSample sample_direction(const Vertex&, const SurfacePoint& surface,
                                     const ScatterUniforms& numbers) const {
        const Vec4f u = numbers.u;
        const float sine = std::sqrt(max_of(0.0f, 1.0f - u.y * u.y));
        const float angle = 2.0f * kPi * u.z;
        const Vec3f local{sine * std::cos(angle), sine * std::sin(angle), u.y};
        const Vec3f wi = make_frame(surface.shading_normal).to_world(local);
        return {wi, kUniformPdf, lambert_pdf_sa(surface, wi)};
    }
    float pdf_sa(const Vertex&, const SurfacePoint& surface, Vec3f wi) const {
        return glm::dot(wi, surface.shading_normal) > 0.0f ? kUniformPdf : 0.0f;
    }
};

template <FeatureSet F>
std::vector<Vec3f> render_with(const HostScene& scene, const RenderSettings& settings, std::uint32_t samples,
                               int threads) {
    const SceneView view = scene.view();
    const BvhIntersector intersector{view};
    const Camera camera = make_camera(settings.camera, settings.width, settings.height);
    const auto width = static_cast<std::uint32_t>(settings.width);
    const auto height = static_cast<std::uint32_t>(settings.height);
    const PathSettings path{.seed = settings.seed,
                            .max_depth = static_cast<std::uint32_t>(settings.max_depth),
                            .next_event = settings.next_event ? 1u : 0u};
    std::vector<Vec3f> pixels(std::size_t{width} * height);
    ChunkQueue queue(0, width * height, width);
    run_on_plain_threads(threads, [&](int) {
        PathCounters counters;
        for (IndexRange range = queue.claim(); !range.empty(); range = queue.claim())
            for (std::uint32_t pixel = range.begin; pixel < range.end; ++pixel) {
                Vec3d sum{0.0};
                for (std::uint32_t sample = 0; sample < samples; ++sample) {
                    auto state = begin_path<F, UniformMethod>(camera, path, {width, height, sample}, pixel);
                    trace_path<F>(PathContext<UniformMethod>{view, UniformMethod{}, path}, intersector, state,
                                  counters);
                    sum += Vec3d{state.radiance};
                }
                pixels[pixel] = Vec3f{sum / static_cast<double>(samples)};
            }
    });
    return pixels;
}

}  // namespace

std::vector<Vec3f> render_uniform(const SceneDescription& scene, const RenderSettings& settings,
                                  std::uint32_t samples, int threads) {
    const HostScene packed = pack_scene(scene);
    if (settings.next_event) return render_with<kEveryFeature>(packed, settings, samples, threads);
    return render_with<kEveryFeature.without(Feature::NextEventEstimation)>(packed, settings, samples, threads);
}

}  // namespace pl::benchmarks
