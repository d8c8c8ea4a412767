#include "tests/bench/embree_loop.h"

#include <string>

#if PL_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "core/kernel/integrator/trace_path.h"
#include "core/kernel/methods/default.h"
#include "cpu/parallel_for.h"

namespace pl::bench {
namespace {

RTCRay to_embree(const Ray& ray) {
    RTCRay result{};
    result.org_x = ray.origin.x;
    result.org_y = ray.origin.y;
    result.org_z = ray.origin.z;
    result.dir_x = ray.direction.x;
    result.dir_y = ray.direction.y;
    result.dir_z = ray.direction.z;
    result.tfar = ray.t_max;
    result.mask = 0xffffffffu;
    return result;
}

/// Embree's own distances and barycentric weights; origins that the kernel moved off the surface are all that keeps a
/// ray from hitting where it starts.
struct SingleRayQueries {
    RTCScene scene;

    Hit closest_hit(const Ray& ray) const {
        RTCRayHit query{to_embree(ray), {}};
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if PL_EMBREE_MAJOR >= 4
        rtcIntersect1(scene, &query);
#else
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(scene, &context, &query);
#endif
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
        return {query.ray.tfar, query.hit.primID, query.hit.u, query.hit.v};
    }
    bool occluded(const Ray& ray) const {
        RTCRay query = to_embree(ray);
#if PL_EMBREE_MAJOR >= 4
        rtcOccluded1(scene, &query);
#else
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcOccluded1(scene, &context, &query);
#endif
        return query.tfar < 0.0f;
    }
};
static_assert(Intersector<SingleRayQueries>);

template <FeatureSet F>
void trace_pixels(const SceneView& scene, const SingleRayQueries& queries, const Camera& camera,
                  const PathSettings& settings, std::uint32_t sample, const FilmView& film, IndexRange range,
                  PassCounters& counters) {
    for (std::uint32_t pixel = range.begin; pixel < range.end; ++pixel) {
        auto state = begin_path<F, DefaultMethod>(camera, settings, {film.width, film.height, sample}, pixel);
        trace_path<F>(PathContext<DefaultMethod>{scene, DefaultMethod{}, settings}, queries, state, counters.path);
        accumulate(film, pixel, state.radiance, sample);
        ++counters.paths;
    }
}

}  // namespace

struct EmbreeLoop::Handles {
    RTCDevice device;
    RTCScene scene;

    Handles() : device(rtcNewDevice(nullptr)), scene(rtcNewScene(device)) {}
    Handles(const Handles&) = delete;
    Handles& operator=(const Handles&) = delete;
    ~Handles() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
};

EmbreeLoop::EmbreeLoop(const HostScene& scene, int width, int height, int threads)
    : handles_(std::make_unique<Handles>()), scene_(scene.view()),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
      width_(static_cast<std::uint32_t>(width)), height_(static_cast<std::uint32_t>(height)), threads_(threads) {
    RTCGeometry geometry = rtcNewGeometry(handles_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), scene.positions.size()));
    for (const Vec3f& position : scene.positions)
        for (int axis = 0; axis < 3; ++axis) *vertices++ = position[axis];
    auto* corners = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), scene.triangles.size()));
    for (const Triangle& triangle : scene.triangles)
        for (const std::uint32_t vertex : {triangle.v0, triangle.v1, triangle.v2}) *corners++ = vertex;
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(handles_->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(handles_->scene);
}

EmbreeLoop::~EmbreeLoop() = default;

PassCounters EmbreeLoop::run_pass(const Camera& camera, const PathSettings& settings, std::uint32_t sample) {
    constexpr std::uint32_t kChunk = 256;
    constexpr FeatureSet kPlain{};
    constexpr FeatureSet kLights = FeatureSet{}.with(Feature::NextEventEstimation);
    const FilmView film{view_of(pixels_), width_, height_};
    const SingleRayQueries queries{handles_->scene};
    ChunkQueue queue(0, film.pixels.count, kChunk);
    std::vector<PassCounters> counters(static_cast<std::size_t>(threads_));
    run_on_threads(threads_, [&](int thread) {
        PassCounters own;
        for (IndexRange range = queue.claim(); !range.empty(); range = queue.claim()) {
            const auto trace = settings.next_event != 0 ? trace_pixels<kLights> : trace_pixels<kPlain>;
            trace(scene_, queries, camera, settings, sample, film, range, own);
        }
        counters[static_cast<std::size_t>(thread)] = own;
    });
    PassCounters total;
    for (const PassCounters& one : counters) total += one;
    return total;
}

double EmbreeLoop::mean() const {
    double sum = 0.0;
    for (const FilmPixel& pixel : pixels_) {
        const Vec3f mean = mean_radiance(pixel);
        sum += (static_cast<double>(mean.x) + mean.y + mean.z) / 3.0;
    }
    return sum / static_cast<double>(pixels_.size());
}

}  // namespace pl::bench
