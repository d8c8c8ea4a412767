// Watertight ray-triangle test.   [Woop, Benthin, Wald 2013, "Watertight Ray/Triangle Intersection", JCGT 2(1)]
// Templates over the number type: float for one ray, a vector of SIMD lanes for many. Both perform the same
// operations in the same order without contraction, so their bits agree.
#pragma once

#include "core/kernel/base/numbers.h"
#include "core/kernel/geometry/ray.h"

namespace pl {

/// Ray space: the dominant axis of the direction is permuted to z, then a shear and scale make the direction (0,0,1).
template <class Real, class Mask>
struct RaySpace {
    Real origin_x, origin_y, origin_z;
    Real shear_x, shear_y, scale_z;
    Mask along_x, along_y;  ///< whether x or y is the dominant axis; neither: z
};

/// A vector of one ray, or of a group of rays in lanes; or a corner in ray space, where the ray is the z axis.
template <class Real>
struct RayVector {
    Real x, y, z;
};

/// Cyclic permutation that brings the dominant axis to z.
template <class Real, class Mask>
PL_INLINE void permute_axes(Mask along_x, Mask along_y, Real& x, Real& y, Real& z) {
    const Real px = select(along_x, y, select(along_y, z, x));
    const Real py = select(along_x, z, select(along_y, x, y));
    const Real pz = select(along_x, x, select(along_y, y, z));
    x = px;
    y = py;
    z = pz;
}

/// `size` holds the magnitudes of the components of `direction`.
template <class Real, class Mask>
PL_INLINE RaySpace<Real, Mask> make_ray_space(const RayVector<Real>& origin, RayVector<Real> direction,
                                              const RayVector<Real>& size, Real one) {
    RaySpace<Real, Mask> space{origin.x,
                               origin.y,
                               origin.z,
                               {},
                               {},
                               {},
                               static_cast<Mask>((size.x > size.y) & (size.x > size.z)),
                               static_cast<Mask>((size.y >= size.x) & (size.y > size.z))};
    permute_axes(space.along_x, space.along_y, direction.x, direction.y, direction.z);
    space.shear_x = direction.x / direction.z;
    space.shear_y = direction.y / direction.z;
    space.scale_z = one / direction.z;
    return space;
}

template <class Real, class Mask>
PL_INLINE RayVector<Real> to_ray_space(const RaySpace<Real, Mask>& space, Real px, Real py, Real pz) {
    Real x = px - space.origin_x;
    Real y = py - space.origin_y;
    Real z = pz - space.origin_z;
    permute_axes(space.along_x, space.along_y, x, y, z);
    return {x - space.shear_x * z, y - space.shear_y * z, space.scale_z * z};
}

/// Edge function: twice the signed area of the triangle of the ray (the origin in x and y) and the edge p -> q.
/// Bitwise antisymmetric: e(p,q) = -e(q,p).
template <class Real>
PL_INLINE Real edge_function(const RayVector<Real>& p, const RayVector<Real>& q) {
    return p.x * q.y - p.y * q.x;
}

/// The three edge functions: scaled barycentric weights u of corner a, v of b, w of c.
template <class Real>
struct EdgeFunctions {
    Real u, v, w;
};

template <class Real>
PL_INLINE EdgeFunctions<Real> edge_functions(const RayVector<Real>& a, const RayVector<Real>& b,
                                             const RayVector<Real>& c) {
    return {edge_function(c, b), edge_function(a, c), edge_function(b, a)};
}

/// Fallback for edge functions that round to 0: in double the products are exact, so the sign is exact for the
/// rounded corners, and triangles that share an edge agree on it.
PL_HD inline float exact_edge_function(const RayVector<float>& p, const RayVector<float>& q) {
    return static_cast<float>(static_cast<double>(p.x) * static_cast<double>(q.y) -
                              static_cast<double>(p.y) * static_cast<double>(q.x));
}

/// Distance scaled by the determinant u + v + w: their quotient is the ray parameter t.
template <class Real>
PL_INLINE Real scaled_distance(const EdgeFunctions<Real>& e, const RayVector<Real>& a, const RayVector<Real>& b,
                               const RayVector<Real>& c) {
    return e.u * a.z + e.v * b.z + e.w * c.z;
}

/// Total order of hits, by distance and then by primitive number, so that the closest hit does not depend on the
/// order of the tests.
PL_HD inline bool is_closer(float t, std::uint32_t primitive, const Hit& best) {
    return t < best.t || (t == best.t && primitive < best.primitive);
}

using ScalarRaySpace = RaySpace<float, bool>;

PL_HD inline ScalarRaySpace make_ray_space(const Ray& ray) {
    const Vec3f& o = ray.origin;
    const Vec3f& d = ray.direction;
    const Vec3f size = absolute(d);
    return make_ray_space<float, bool>({o.x, o.y, o.z}, {d.x, d.y, d.z}, {size.x, size.y, size.z}, 1.0f);
}

/// Two-sided test of one triangle; updates `best` if the hit is closer. `best.t` starts as the ray's t_max. The
/// caller excludes source and target.
PL_HD inline void intersect_triangle(const ScalarRaySpace& space, Vec3f p0, Vec3f p1, Vec3f p2,
                                     std::uint32_t primitive, Hit& best) {
    const auto a = to_ray_space(space, p0.x, p0.y, p0.z);
    const auto b = to_ray_space(space, p1.x, p1.y, p1.z);
    const auto c = to_ray_space(space, p2.x, p2.y, p2.z);
    auto e = edge_functions(a, b, c);
    if (e.u == 0.0f || e.v == 0.0f || e.w == 0.0f)
        e = {exact_edge_function(c, b), exact_edge_function(a, c), exact_edge_function(b, a)};
    const bool any_negative = e.u < 0.0f || e.v < 0.0f || e.w < 0.0f;
    const bool any_positive = e.u > 0.0f || e.v > 0.0f || e.w > 0.0f;
    if (any_negative && any_positive) return;
    const float determinant = e.u + e.v + e.w;
    if (!(determinant != 0.0f)) return;
    const float t = scaled_distance(e, a, b, c) / determinant;
    if (!(t > 0.0f) || !is_closer(t, primitive, best)) return;
    best = {t, primitive, e.v / determinant, e.w / determinant};
}

}  // namespace pl
