// From a hit to a surface point, and from there to the next ray without self-intersection.
#pragma once

#include "core/kernel/base/features.h"
#include "core/kernel/base/numbers.h"
#include "core/kernel/scene/normal_map.h"
#include "core/kernel/scene/triangle_plane.h"

namespace pl {

/// A surface point seen from direction `wo`. Both normals lie on the side of `wo`.
struct SurfacePoint {
    Vec3f position{0.0f};
    Vec3f geometric_normal{0.0f, 0.0f, 1.0f};
    Vec3f shading_normal{0.0f, 0.0f, 1.0f};
    float position_error = 0.0f;  ///< distance to offset ray origins along the geometric normal
    std::uint32_t primitive = kNoPrimitive;
    std::uint32_t material = 0;
    bool front = true;  ///< `wo` is on the front side of the triangle
};

/// Barycentric weights (b0, b1, b2).
PL_HD inline Vec3f hit_weights(const Hit& hit) { return {1.0f - hit.b1 - hit.b2, hit.b1, hit.b2}; }

/// Barycentric weights (b0, b1, b2), each at least about `margin`.
template <class N>
PL_INLINE Real3<N> inner_barycentrics(const typename N::Real& b1, const typename N::Real& b2,
                                      const typename N::Real& margin) {
    const auto at_least = [&](const typename N::Real& b) {
        return select(static_cast<typename N::Mask>(b < margin), margin, b);
    };
    const Real3<N> b{at_least(1.0f - b1 - b2), at_least(b1), at_least(b2)};
    return scaled(b, 1.0f / (b.x + b.y + b.z));
}
PL_HD inline Vec3f inner_barycentrics(const Hit& hit, float margin) {
    return pack(inner_barycentrics<One>(hit.b1, hit.b2, margin));
}

/// Corners of a triangle.
template <class N>
struct CornersOf {
    Real3<N> p0, p1, p2;

    /// The point at barycentric weights.
    PL_INLINE Real3<N> at(const Real3<N>& b) const { return scaled(p0, b.x) + scaled(p1, b.y) + scaled(p2, b.z); }
    PL_INLINE CornersOf relative_to(const Real3<N>& origin) const { return {p0 - origin, p1 - origin, p2 - origin}; }
    /// Unnormalized normal; its length is twice the area.
    PL_INLINE Real3<N> normal() const { return cross(p1 - p0, p2 - p0); }
};
PL_HD inline CornersOf<One> corners_of(const SceneView& scene, const Triangle& triangle) {
    return {unpack(scene.positions[triangle.v0]), unpack(scene.positions[triangle.v1]),
            unpack(scene.positions[triangle.v2])};
}

/// Number in SceneView::triangles of the triangle that a primitive is, or shows if it is of an instance.
template <FeatureSet F>
PL_HD inline std::uint32_t triangle_of(const SceneView& scene, std::uint32_t primitive) {
    if constexpr (F.has(Feature::Instances)) {
        if (primitive >= scene.direct_triangles()) {
            const Instance& instance = scene.instances.instance_of(primitive);
            return instance.first_triangle + (primitive - instance.first_primitive);
        }
    }
    return primitive;
}

/// A primitive in the space of the scene.
struct FlatPrimitive {
    CornersOf<One> corners;
    TrianglePlane plane;
    std::uint32_t material;
};
/// One that an instance shows.
PL_HD_APART FlatPrimitive instance_primitive(const SceneView& scene, std::uint32_t primitive) {
    const Instance& instance = scene.instances.instance_of(primitive);
    const Triangle triangle = scene.triangles[instance.first_triangle + (primitive - instance.first_primitive)];
    const Vec3f p0 = instance.to_world.point(scene.positions[triangle.v0]);
    const Vec3f p1 = instance.to_world.point(scene.positions[triangle.v1]);
    const Vec3f p2 = instance.to_world.point(scene.positions[triangle.v2]);
    return {{unpack(p0), unpack(p1), unpack(p2)},
            make_triangle_plane({p0, p1, p2}, scene.instances.longest_edge),
            triangle.material};
}
template <FeatureSet F>
PL_HD inline FlatPrimitive flat_primitive(const SceneView& scene, std::uint32_t primitive) {
    if constexpr (F.has(Feature::Instances)) {
        if (primitive >= scene.direct_triangles()) return instance_primitive(scene, primitive);
    }
    const Triangle triangle = scene.triangles[primitive];
    return {corners_of(scene, triangle), scene.planes[primitive], triangle.material};
}

/// The direction of u on a primitive.
template <FeatureSet F>
PL_HD inline TextureAxis texture_axis(const SceneView& scene, std::uint32_t primitive) {
    const CornersOf<One> corners = flat_primitive<F>(scene, primitive).corners;
    return texture_axis(scene.textures, triangle_of<F>(scene, primitive), pack(corners.p0), pack(corners.p1),
                        pack(corners.p2));
}

/// `v` at unit length; `otherwise` if its length is 0.
template <class N>
PL_INLINE Real3<N> unit_or(const Real3<N>& v, const Real3<N>& otherwise) {
    const auto length2 = dot(v, v);
    return select(static_cast<typename N::Mask>(length2 > 0.0f), scaled(v, 1.0f / N::sqrt(length2)), otherwise);
}
/// A normal of either side, turned to the side of the geometric normal.
template <class N>
PL_INLINE Real3<N> turned_to(const Real3<N>& geometric_normal, const Real3<N>& normal) {
    const auto is_same_side = static_cast<typename N::Mask>(dot(normal, geometric_normal) >= 0.0f);
    return scaled(normal, select(is_same_side, N::constant(1.0f), N::constant(-1.0f)));
}

/// The interpolated shading normal of the front side. The normal of an instance is interpolated in the space of its
/// mesh.
template <FeatureSet F>
PL_HD inline Vec3f interpolate_normal(const SceneView& scene, std::uint32_t primitive, Vec3f b, Vec3f fallback) {
    if constexpr (F.has(Feature::SmoothNormals)) {
        if (!scene.triangle_normals.empty()) {
            const TriangleNormals t = scene.triangle_normals[triangle_of<F>(scene, primitive)];
            Vec3f n = b.x * scene.normals[t.n0] + b.y * scene.normals[t.n1] + b.z * scene.normals[t.n2];
            if constexpr (F.has(Feature::Instances)) {
                if (primitive >= scene.direct_triangles())
                    n = scene.instances.instance_of(primitive).to_mesh.transposed(n);
            }
            return pack(unit_or(unpack(n), unpack(fallback)));
        }
    }
    return fallback;
}

/// Geometric normal of the front side.
template <FeatureSet F>
PL_HD inline Vec3f front_normal(const SceneView& scene, const SurfacePoint& point) {
    if constexpr (F.has(Feature::Instances))
        return (point.front ? 1.0f : -1.0f) * point.geometric_normal;
    else
        return scene.planes[point.primitive].normal;
}

/// The shading normal of a surface whose normals come from an image.
template <FeatureSet F>
PL_HOST_APART PL_HD inline Vec3f mapped_shading_normal(const SceneView& scene, const SurfacePoint& point,
                                                       Vec3f attributes) {
    const float side = point.front ? 1.0f : -1.0f;
    const MappedPoint mapped{point.material, triangle_of<F>(scene, point.primitive),
                             texture_axis<F>(scene, point.primitive), attributes, front_normal<F>(scene, point)};
    return side * mapped_normal(scene.textures, mapped, side * point.shading_normal);
}

/// The point with its shading normal: interpolated if F has SmoothNormals, by the normal map if F has NormalMaps; `attributes` are the
/// barycentric weights of both.
template <FeatureSet F>
PL_HD inline SurfacePoint with_shading_normal(const SceneView& scene, SurfacePoint point, Vec3f attributes) {
    if constexpr (F.has(Feature::SmoothNormals)) {
        // Normals of a file may disagree with the winding.
        const Vec3f smooth = interpolate_normal<F>(scene, point.primitive, attributes, front_normal<F>(scene, point));
        point.shading_normal = pack(turned_to(unpack(point.geometric_normal), unpack(smooth)));
    }
    if constexpr (F.has(Feature::NormalMaps)) {
        if (has_normal_map(scene.textures, point.material))
            point.shading_normal = mapped_shading_normal<F>(scene, point, attributes);
    }
    return point;
}

/// Point at barycentric weights `b` of a triangle, seen from `wo`; the shading normal is the geometric normal.
PL_HD inline SurfacePoint make_flat_point(const FlatPrimitive& flat, std::uint32_t primitive, Vec3f b, Vec3f wo) {
    SurfacePoint point;
    point.position = pack(flat.corners.at(unpack(b)));
    point.position_error = flat.plane.position_error;
    point.primitive = primitive;
    point.material = flat.material;
    point.front = glm::dot(flat.plane.normal, wo) >= 0.0f;
    point.geometric_normal = (point.front ? 1.0f : -1.0f) * flat.plane.normal;
    point.shading_normal = point.geometric_normal;
    return point;
}

/// Point at exactly these barycentric weights, with its shading normal.
template <FeatureSet F>
PL_HD inline SurfacePoint make_surface_point(const SceneView& scene, std::uint32_t primitive, Vec3f b, Vec3f wo) {
    return with_shading_normal<F>(scene, make_flat_point(flat_primitive<F>(scene, primitive), primitive, b, wo), b);
}

/// Point of a hit, kept at a distance from the triangle's edges so that rounding cannot put the origin of the next
/// ray behind an adjacent wall. Only the position moves: normals stay smooth on the smallest triangles.
template <FeatureSet F>
PL_HD inline SurfacePoint make_flat_point(const SceneView& scene, const Hit& hit, Vec3f wo) {
    const FlatPrimitive flat = flat_primitive<F>(scene, hit.primitive);
    return make_flat_point(flat, hit.primitive, inner_barycentrics(hit, flat.plane.edge_margin), wo);
}
template <FeatureSet F>
PL_HD inline SurfacePoint make_surface_point(const SceneView& scene, const Hit& hit, Vec3f wo) {
    if constexpr (F.has_any(kNormalFeatures))
        return with_shading_normal<F>(scene, make_flat_point<F>(scene, hit, wo), hit_weights(hit));
    else
        return make_flat_point<F>(scene, hit, wo);
}

/// A surface point without its surface: its normal is on any side. `error`: SurfacePoint::position_error.
template <class N>
struct SpawnPoint {
    Real3<N> position, normal;
    typename N::Real error;
};
PL_HD inline SpawnPoint<One> spawn_point(const SurfacePoint& point) {
    return {unpack(point.position), unpack(point.geometric_normal), point.position_error};
}

/// coordinate + offset, rounded away from `coordinate` by one float.
template <class N>
PL_INLINE typename N::Real offset_outwards(const typename N::Real& coordinate, const typename N::Real& offset) {
    const auto up = select(static_cast<typename N::Mask>(offset > 0.0f), N::constant(1), N::constant(0));
    const auto down = select(static_cast<typename N::Mask>(offset < 0.0f), N::constant(1), N::constant(0));
    return step_real<N>(coordinate + offset, up - down);
}

/// Origin of a ray in `direction`, outside of the error bounds of the point, on the side of the direction.   [Pharr,
/// Jakob, Humphreys, Physically Based Rendering, 4th ed., 6.8.6]
template <class N>
PL_INLINE Real3<N> spawn_origin(const SpawnPoint<N>& point, const Real3<N>& direction) {
    const typename N::Mask above = dot(direction, point.normal) >= 0.0f;
    const auto side = select(above, N::constant(1.0f), N::constant(-1.0f));
    const Real3<N> offset = scaled(point.normal, side * point.error);
    return {offset_outwards<N>(point.position.x, offset.x), offset_outwards<N>(point.position.y, offset.y),
            offset_outwards<N>(point.position.z, offset.z)};
}
PL_HD inline Vec3f spawn_origin(const SurfacePoint& point, Vec3f direction) {
    return pack(spawn_origin(spawn_point(point), unpack(direction)));
}

PL_HD inline Ray spawn_ray(const SurfacePoint& point, Vec3f direction) {
    return {.origin = spawn_origin(point, direction), .direction = direction, .source = point.primitive};
}

/// The part of a ray with t in (0, 1).
template <class N>
struct RaySegment {
    Real3<N> origin, direction;
};
/// Between two surface points, on the sides that they see each other on.
template <class N>
PL_INLINE RaySegment<N> spawn_segment(const SpawnPoint<N>& from, const SpawnPoint<N>& to) {
    const Real3<N> direction = to.position - from.position;
    const Real3<N> origin = spawn_origin(from, direction);
    return {origin, spawn_origin(to, -direction) - origin};
}

/// Shadow ray between two surface points, t in (0, 1), that excludes both triangles.
PL_HD inline Ray spawn_shadow_ray(const SurfacePoint& from, const SurfacePoint& to) {
    const RaySegment<One> segment = spawn_segment(spawn_point(from), spawn_point(to));
    return {.origin = pack(segment.origin),
            .direction = pack(segment.direction),
            .t_max = 1.0f,
            .source = from.primitive,
            .target = to.primitive};
}

}  // namespace pl
