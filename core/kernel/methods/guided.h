// What both learning methods share: one-sample mixture of BSDF and learned table.
#pragma once

#include "core/kernel/fields/direction_table.h"
#include "core/kernel/fields/mixture.h"
#include "core/kernel/methods/method.h"

namespace pl {

struct GuidedVertex {
    std::int32_t volume = kNoVolume;
};

/// Radiance (luminance) that the first vertex was expected to reflect; 0 if nothing was known there.
struct GuidedExpectation {
    float first = 0.0f;
};

/// q = a p_bsdf + (1-a) p_table, with both densities evaluated whichever of the two chose the direction. A direction
/// weighs at most 1/a times what it weighs under BSDF sampling.   [Veach 1997, 9.2.4; Mueller et al. 2017]
struct GuidedSampling {
    FieldView field;
    MixtureSettings mixture{};

    /// a, in (0, 1]
    PL_HD float bsdf_fraction(std::int32_t volume) const {
        return mixture.learned != 0 ? field.bsdf_fraction[static_cast<std::uint32_t>(volume)] : mixture.bsdf_fraction;
    }

    PL_HD GuidedVertex arrive(const SurfacePoint& surface, MethodCounters& counters) const {
        const std::int32_t volume = field.volume_at(surface);
        ++counters.lookups;
        counters.lookup_misses += volume == kNoVolume ? 1u : 0u;
        return {volume};
    }

    PL_HD float pdf_sa(const GuidedVertex& vertex, const SurfacePoint& surface, Vec3f wi) const {
        return weigh(vertex, surface, wi).pdf_sa;
    }
    /// The direction with all its densities, as if it had been sampled.
    PL_HD DirectionSample weigh(const GuidedVertex& vertex, const SurfacePoint& surface, Vec3f wi) const {
        const float bsdf_pdf_sa = lambert_pdf_sa(surface, wi);
        if (vertex.volume == kNoVolume) return {wi, bsdf_pdf_sa, bsdf_pdf_sa};
        const Vec3f local = field.frame(vertex.volume).to_local(wi);
        const TableDensity table = table_density(DirectionTable(field, vertex.volume), local);
        const float a = bsdf_fraction(vertex.volume);
        return {wi, a * bsdf_pdf_sa + (1.0f - a) * table.pdf_sa, bsdf_pdf_sa, table.cell};
    }

    PL_HD DirectionSample sample_direction(const GuidedVertex& vertex, const SurfacePoint& surface, const Rng& rng,
                                           std::uint32_t index, Vec4f u) const {
        Vec3f wi;
        if (vertex.volume == kNoVolume || u.x < bsdf_fraction(vertex.volume)) {
            wi = lambert_sample(surface, {u.y, u.z});
        } else {
            const Vec4f jitter = rng.draw(index, Purpose::CellJitter);
            const Vec2f square =
                sample_square(DirectionTable(field, vertex.volume), {u.y, u.z}, {jitter.x, jitter.y});
            wi = field.frame(vertex.volume).to_world(square_to_cosine_hemisphere(square));
        }
        return weigh(vertex, surface, wi);
    }

    /// What the path can still bring, by what is learned, as a share of what its first vertex was expected to. A
    /// direction guided towards light weighs little but leads where much is expected, so it is not ended for its low
    /// throughput; one that strays into the dark is.   [after Vorba and Krivanek 2016, "Adjoint-Driven Russian
    /// Roulette and Splitting in Light Transport Simulation"]
    PL_HD float roulette_worth(const GuidedVertex& vertex, Vec3f albedo, Vec3f throughput, float survival,
                               GuidedExpectation& expectation) const {
        if (vertex.volume == kNoVolume) return survival;
        const float expected =
            luminance(throughput * albedo) * field.mean_radiance[static_cast<std::uint32_t>(vertex.volume)];
        if (expectation.first == 0.0f) expectation.first = expected;
        return expectation.first > 0.0f ? expected / expectation.first : survival;
    }
};

}  // namespace pl
