// A scene in Embree, the peer of tests and benchmarks: its single-ray queries, as fast as they are. Embree 3 or 4.
#pragma once

#if PL_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "core/kernel/geometry/intersector.h"
#include "core/scene/scene_storage.h"

namespace pl::test {

/// Satisfies Intersector, but for excluded triangles: origins that the kernel moved off the surface are all that keeps a ray from
/// hitting where it starts. Distances and barycentric weights are Embree's own.
class EmbreeScene {
public:
    explicit EmbreeScene(const HostScene& scene) : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), scene.positions.size()));
        for (const Vec3f& position : scene.positions)
            for (int axis = 0; axis < 3; ++axis) *vertices++ = position[axis];
        auto* corners = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), scene.triangles.size()));
        for (const Triangle& triangle : scene.triangles)
            for (const std::uint32_t vertex : {triangle.v0, triangle.v1, triangle.v2}) *corners++ = vertex;
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_);
    }
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;
    ~EmbreeScene() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }

    Hit closest_hit(const Ray& ray) const {
        RTCRayHit query{to_embree(ray), {}};
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if PL_EMBREE_MAJOR >= 4
        rtcIntersect1(scene_, &query);
#else
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(scene_, &context, &query);
#endif
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
        return {query.ray.tfar, query.hit.primID, query.hit.u, query.hit.v};
    }
    bool occluded(const Ray& ray) const {
        RTCRay query = to_embree(ray);
#if PL_EMBREE_MAJOR >= 4
        rtcOccluded1(scene_, &query);
#else
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcOccluded1(scene_, &context, &query);
#endif
        return query.tfar < 0.0f;
    }

private:
    static RTCRay to_embree(const Ray& ray) {
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

    RTCDevice device_;
    RTCScene scene_;
};
static_assert(Intersector<EmbreeScene>);

}  // namespace pl::test
