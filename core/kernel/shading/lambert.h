// The Lambert lobe: f = albedo / pi on the upper side of the shading normal.
#pragma once

#include "core/kernel/base/frame.h"
#include "core/kernel/base/warp.h"
#include "core/kernel/scene/surface_point.h"

namespace pl {

/// cos(theta_i) at the shading normal; 0 below the geometric or the shading horizon.
template <class N>
PL_INLINE typename N::Real reflection_cosine(const Real3<N>& geometric_normal, const Real3<N>& shading_normal,
                                             const Real3<N>& wi) {
    const typename N::Mask below = dot(wi, geometric_normal) <= 0.0f;
    return select(below, N::constant(0.0f), max_real<N>(dot(wi, shading_normal), 0.0f));
}
PL_HD inline float reflection_cosine(const SurfacePoint& surface, Vec3f wi) {
    return reflection_cosine(unpack(surface.geometric_normal), unpack(surface.shading_normal), unpack(wi));
}

/// BSDF times cos(theta_i), 1/sr.
template <class N>
PL_INLINE Real3<N> lambert_eval(const Real3<N>& albedo, const typename N::Real& cos_i) {
    return scaled(albedo, cos_i * kInvPi);
}
PL_HD inline Vec3f lambert_eval(Vec3f albedo, float cos_i) { return pack(lambert_eval(unpack(albedo), cos_i)); }

/// Cosine-weighted direction around the shading normal; u in [0,1)^2. Density: lambert_pdf_sa.
PL_HD inline Vec3f lambert_sample(const SurfacePoint& surface, Vec2f u) {
    return make_frame(surface.shading_normal).to_world(square_to_cosine_hemisphere(u));
}

/// Density of lambert_sample per steradian. Directions between the shading and the geometric horizon have a density
/// but a BSDF of 0: samples of value 0.
PL_HD inline float lambert_pdf_sa(const SurfacePoint& surface, Vec3f wi) {
    return cosine_hemisphere_pdf_sa(glm::dot(wi, surface.shading_normal));
}

}  // namespace pl
