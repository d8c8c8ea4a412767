// Default path tracing: directions from the BSDF alone, nothing learned.
#pragma once

#include "core/kernel/methods/method.h"

namespace pl {

struct DefaultMethod {
    static constexpr bool kSplitsPaths = false;

    struct Vertex {};
    struct Memory {};
    struct Expectation {};
    struct Record {};

    PL_HD Vertex arrive(const SurfacePoint&, MethodCounters&) const { return {}; }

    PL_HD DirectionSample sample_direction(const Vertex&, const SurfacePoint& surface, const Rng&, std::uint32_t,
                                           Vec4f u) const {
        return weigh_lambert(surface, lambert_sample(surface, {u.y, u.z}));
    }

    PL_HD float pdf_sa(const Vertex&, const SurfacePoint& surface, Vec3f wi) const {
        return lambert_pdf_sa(surface, wi);
    }

    PL_HD DirectionSample sample_direction(const Vertex&, const SurfacePoint& surface, const LayeredBsdf& bsdf,
                                           const Rng&, std::uint32_t, Vec4f u, float choice) const {
        return sample_bsdf(surface, bsdf, u, choice);
    }
    PL_HD float pdf_sa(const Vertex&, const SurfacePoint& surface, const LayeredBsdf& bsdf, Vec3f wi) const {
        return bsdf.pdf_sa(surface, wi);
    }

    PL_HD float roulette_worth(const Vertex&, Vec3f, Vec3f, float survival, Expectation&) const { return survival; }

    PL_HD Memory remember(const Vertex&, const DirectionSample&) const { return {}; }
    PL_HD Record learn(const Memory&, const Arrival&, const Vertex&, MethodCounters&) const { return {}; }
    PL_HD void commit(const Record&) const {}
};
static_assert(Method<DefaultMethod>);

}  // namespace pl
