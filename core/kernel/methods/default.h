// Default path tracing: directions are sampled from the BSDF alone; nothing is learned.
#pragma once

#include "core/kernel/methods/method.h"
#include "core/kernel/methods/method_info.h"

namespace pl {

struct DefaultMethod : MethodHooks {
    PL_HD DirectionSample sample_direction(const Vertex&, const SurfacePoint& surface,
                                           const ScatterUniforms& uniforms) const {
        return weigh_lambert(surface, lambert_sample(surface, {uniforms.u.y, uniforms.u.z}));
    }
    PL_HD float pdf_sa(const Vertex&, const SurfacePoint& surface, Vec3f wi) const {
        return lambert_pdf_sa(surface, wi);
    }

    template <FeatureSet B>
    PL_HD DirectionSample sample_direction(const Vertex&, const SurfacePoint& surface, const LayeredBsdf<B>& bsdf,
                                           const ScatterUniforms& uniforms) const {
        return sample_bsdf(surface, bsdf, uniforms);
    }
    template <FeatureSet B>
    PL_HD float pdf_sa(const Vertex&, const SurfacePoint& surface, const LayeredBsdf<B>& bsdf, Vec3f wi) const {
        return bsdf.pdf_sa(surface, wi);
    }
};
static_assert(Method<DefaultMethod>);

struct Default {
    static constexpr MethodInfo kInfo{.name = "default",
                                      .label = "Default",
                                      .summary = "Directions from the surface's reflectance alone.",
                                      .key = '1',
                                      .color = 0xff56b4e9u};
};

}  // namespace pl
