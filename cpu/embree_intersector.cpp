#include "cpu/embree_intersector.h"

#include <cfenv>
#include <type_traits>

#if PL_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <fmt/format.h>

#include "core/base/error.h"
#include "core/kernel/geometry/intersector.h"

namespace pl {
namespace {

// Embree 3 and 4 name the context of a query differently.
#if PL_EMBREE_MAJOR >= 4
using QueryContext = RTCRayQueryContext;
#else
using QueryContext = RTCIntersectContext;
#endif

/// A ray traced by Embree, and its closest hit so far according to the watertight test.
struct Query {
    QueryContext context;  ///< first member: Embree passes its address to the filter
    const SceneView* scene;
    Ray ray;
    ScalarRaySpace space;
    Hit best;
    bool disagreed = false;  ///< the watertight test rejected a candidate of Embree

    Query(const SceneView& scene_view, const Ray& traced)
        : scene(&scene_view), ray(traced), space(make_ray_space(traced)), best{.t = traced.t_max} {
#if PL_EMBREE_MAJOR >= 4
        rtcInitRayQueryContext(&context);
#else
        rtcInitIntersectContext(&context);
#endif
    }

    /// True if the watertight test accepts this triangle as the new closest hit.
    bool consider(std::uint32_t primitive) {
        if (primitive == ray.source || primitive == ray.target) return false;
        const Triangle& triangle = scene->triangles[primitive];
        intersect_triangle(space, scene->positions[triangle.v0], scene->positions[triangle.v1],
                           scene->positions[triangle.v2], primitive, best);
        disagreed = disagreed || best.primitive != primitive;
        return best.primitive == primitive;
    }

    /// After a rejected candidate, Embree may not report the triangle that the watertight test accepts instead: the
    /// neighbor at an edge. Even in robust mode, Embree may miss a closed mesh at a corner; the watertight test never
    /// does. Both cases traverse the scene's BVH: rejections are rare, and a miss ends its path.
    Hit closest() const { return disagreed || !best.found() ? BvhIntersector{*scene}.closest_hit(ray) : best; }
    /// Misses are not traced again: most shadow rays are unoccluded, and one false miss in millions is negligible.
    bool occluded() const { return best.found() || (disagreed && BvhIntersector{*scene}.occluded(ray)); }
};
static_assert(std::is_standard_layout_v<Query>);

/// Filter callback: Embree calls it for every candidate hit. Single rays only.
void filter_hit(const RTCFilterFunctionNArguments* arguments) {
    auto* query = reinterpret_cast<Query*>(arguments->context);
    const auto* hit = reinterpret_cast<const RTCHit*>(arguments->hit);
    if (!query->consider(hit->primID)) arguments->valid[0] = 0;
}

RTCRay to_embree(const Ray& ray) {
    return {.org_x = ray.origin.x,
            .org_y = ray.origin.y,
            .org_z = ray.origin.z,
            .tnear = 0.0f,
            .dir_x = ray.direction.x,
            .dir_y = ray.direction.y,
            .dir_z = ray.direction.z,
            .time = 0.0f,
            .tfar = ray.t_max,
            .mask = 0xffffffffu,
            .id = 0,
            .flags = 0};
}

/// Restores rounding and denormal modes: building Embree's hierarchy may disable denormals in the calling thread,
/// which would change the bits of pictures.
class FloatModeGuard {
public:
    FloatModeGuard() { std::fegetenv(&saved_); }
    ~FloatModeGuard() { std::fesetenv(&saved_); }
    FloatModeGuard(const FloatModeGuard&) = delete;
    FloatModeGuard& operator=(const FloatModeGuard&) = delete;

private:
    std::fenv_t saved_;
};

void fill_geometry(RTCGeometry geometry, const SceneView& scene) {
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), scene.positions.count));
    for (const Vec3f& position : scene.positions)
        for (int axis = 0; axis < 3; ++axis) *vertices++ = position[axis];
    auto* corners = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), scene.direct_triangles()));
    for (std::uint32_t i = 0; i < scene.direct_triangles(); ++i) {
        const Triangle& triangle = scene.triangles[i];
        for (const std::uint32_t vertex : {triangle.v0, triangle.v1, triangle.v2}) *corners++ = vertex;
    }
}

}  // namespace

struct EmbreeIntersector::Handles {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

    Handles() = default;
    Handles(const Handles&) = delete;
    Handles& operator=(const Handles&) = delete;
    ~Handles() {
        if (scene != nullptr) rtcReleaseScene(scene);
        if (device != nullptr) rtcReleaseDevice(device);
    }

    void check(const char* step) const {
        const RTCError error = rtcGetDeviceError(device);
        if (error != RTC_ERROR_NONE)
            throw Error(ErrorKind::Runtime,
                        fmt::format("Embree: {} failed with error {}", step, static_cast<int>(error)));
    }
};

EmbreeIntersector::EmbreeIntersector(const SceneView& scene, int threads)
    : handles_(std::make_unique<Handles>()), scene_(scene) {
    const FloatModeGuard guard;
    handles_->device = rtcNewDevice(fmt::format("threads={}", threads).c_str());
    handles_->check("opening the device");
    handles_->scene = rtcNewScene(handles_->device);
    rtcSetSceneFlags(handles_->scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(handles_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    fill_geometry(geometry, scene);
    rtcSetGeometryIntersectFilterFunction(geometry, filter_hit);
    rtcSetGeometryOccludedFilterFunction(geometry, filter_hit);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(handles_->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(handles_->scene);
    handles_->check("building the hierarchy");
}

EmbreeIntersector::~EmbreeIntersector() = default;
EmbreeIntersector::EmbreeIntersector(EmbreeIntersector&&) noexcept = default;
EmbreeIntersector& EmbreeIntersector::operator=(EmbreeIntersector&&) noexcept = default;

void EmbreeIntersector::find_closest(RayBatch& batch, std::uint32_t count) const {
    for (std::uint32_t i = 0; i < count; ++i) {
        Query query(scene_, batch.ray(i));
        RTCRayHit embree{.ray = to_embree(query.ray), .hit = {}};
        embree.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if PL_EMBREE_MAJOR >= 4
        RTCIntersectArguments arguments;
        rtcInitIntersectArguments(&arguments);
        arguments.context = &query.context;
        rtcIntersect1(handles_->scene, &embree, &arguments);
#else
        rtcIntersect1(handles_->scene, &query.context, &embree);
#endif
        batch.set_hit(i, query.closest());
    }
}

void EmbreeIntersector::find_occluded(RayBatch& batch, std::uint32_t count) const {
    for (std::uint32_t i = 0; i < count; ++i) {
        Query query(scene_, batch.ray(i));
        RTCRay embree = to_embree(query.ray);
#if PL_EMBREE_MAJOR >= 4
        RTCOccludedArguments arguments;
        rtcInitOccludedArguments(&arguments);
        arguments.context = &query.context;
        rtcOccluded1(handles_->scene, &embree, &arguments);
#else
        rtcOccluded1(handles_->scene, &query.context, &embree);
#endif
        batch.set_occluded(i, query.occluded());
    }
}

std::string EmbreeIntersector::version() { return RTC_VERSION_STRING; }

}  // namespace pl
