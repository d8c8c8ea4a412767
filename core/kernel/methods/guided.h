// What both learning methods share: one-sample mixture of BSDF and learned table.
#pragma once

#include "core/kernel/fields/direction_table.h"
#include "core/kernel/fields/mixture.h"
#include "core/kernel/fields/parallax.h"
#include "core/kernel/fields/reach.h"
#include "core/kernel/methods/method.h"

namespace pl {

struct GuidedVertex {
    std::int32_t volume = kNoVolume;
};

/// Radiance (luminance) that the first vertex was expected to reflect; 0 if nothing was known there.
struct GuidedExpectation {
    float first = 0.0f;
};

/// DirectionSample for one direction, or for several at once.
template <class N>
struct GuidedDirection {
    Real3<N> wi;
    typename N::Real pdf_sa, bsdf_pdf_sa;
    typename N::Int cell;
};

/// Where a path stands, as a mixture sees it; `volume` is kNoVolume where none serves.
template <class N>
struct GuidedPlace {
    typename N::Int volume;
    Real3<N> position, shading_normal;
};

/// q = a p_bsdf + (1-a) p_table, with both densities evaluated whichever of the two chose the direction. A direction
/// weighs at most 1/a times what it weighs under BSDF sampling.   [Veach 1997, 9.2.4; Mueller et al. 2017]
/// Plain pointers, for code that is compiled apart; of at least one volume.
struct GuidedMixture {
    DirectionCells cells;
    const float* row_cdf = nullptr;        ///< [volume][row]
    const float* column_cdf = nullptr;     ///< [volume][row][column]
    const float* normals = nullptr;        ///< [volume][3]
    const float* sites = nullptr;          ///< [volume][kSiteStride], of which the first three are the position
    const float* inverse_reach = nullptr;  ///< [volume]
    const float* bsdf_fraction = nullptr;  ///< a, in (0, 1]. [volume]; null: the same for all
    float same_bsdf_fraction = 1.0f;

    static constexpr int kSiteStride = sizeof(SurfacePoint) / sizeof(float);
    static_assert(kSiteStride * sizeof(float) == sizeof(SurfacePoint));

    /// Draws a direction: u.x chooses between BSDF and table, u.y and u.z the direction, jitter() two further numbers.
    template <class N, class Jitter>
    PL_INLINE GuidedDirection<N> sample(const GuidedPlace<N>& place, typename N::Real choice, const Real2<N>& u,
                                        Jitter&& jitter) const {
        const typename N::Mask served = place.volume >= 0;
        const auto index = select(served, place.volume, N::constant(0));
        const Real3<N> volume_normal = normal_of<N>(index);
        const typename N::Mask guided = served & (choice >= fraction_of<N>(index));
        Real2<N> square = u;
        if (N::any(guided)) square = select(guided, sample_square(tables_of<N>(index), u, jitter()), u);
        const FrameOf<N> frame = make_frame(select(guided, volume_normal, place.shading_normal));
        const Real3<N> direction = frame.to_world(square_to_cosine_hemisphere(square));
        const Parallax<N> parallax = parallax_of(index, place.position);
        const Real3<N> wi = select(guided, parallax.to_point(direction), direction);
        return weigh(place, parallax, wi, cosine_pdf_sa<N>(dot(wi, place.shading_normal)));
    }

    /// A direction with all its densities, as if it had been sampled, at a Lambert reflector.
    template <class N>
    PL_INLINE GuidedDirection<N> weigh(const GuidedPlace<N>& place, const Real3<N>& wi) const {
        return weigh(place, wi, cosine_pdf_sa<N>(dot(wi, place.shading_normal)));
    }
    /// The same where BSDF sampling has another density.
    template <class N>
    PL_INLINE GuidedDirection<N> weigh(const GuidedPlace<N>& place, const Real3<N>& wi,
                                       typename N::Real bsdf_pdf_sa) const {
        const typename N::Mask served = place.volume >= 0;
        return weigh(place, parallax_of(select(served, place.volume, N::constant(0)), place.position), wi,
                     bsdf_pdf_sa);
    }

    /// A direction from the table alone, at a place that a volume serves.
    PL_HD Vec3f sample_table(const GuidedPlace<One>& place, Vec2f u, Vec2f jitter) const {
        const Real2<One> square = sample_square(tables_of<One>(place.volume), unpack(u), unpack(jitter));
        const Real3<One> direction =
            make_frame(normal_of<One>(place.volume)).to_world(square_to_cosine_hemisphere(square));
        return pack(parallax_of<One>(place.volume, place.position).to_point(direction));
    }
    PL_HD float bsdf_share(std::int32_t volume) const { return fraction_of<One>(volume); }

private:
    template <class N>
    PL_INLINE GuidedDirection<N> weigh(const GuidedPlace<N>& place, const Parallax<N>& parallax, const Real3<N>& wi,
                                       typename N::Real bsdf_pdf_sa) const {
        const typename N::Mask served = place.volume >= 0;
        const auto index = select(served, place.volume, N::constant(0));
        const SiteDirection<N> seen = parallax.to_site(wi);
        const Real3<N> local = make_frame(normal_of<N>(index)).to_local(seen.direction);
        const TableDensity<N> table = table_density(tables_of<N>(index), local);
        const auto a = fraction_of<N>(index);
        const auto mixed = a * bsdf_pdf_sa + (1.0f - a) * (table.pdf_sa * seen.steradians);
        return {wi, select(served, mixed, bsdf_pdf_sa), bsdf_pdf_sa, select(served, table.cell, N::constant(-1))};
    }
    template <class N>
    PL_INLINE Parallax<N> parallax_of(typename N::Int volume, const Real3<N>& position) const {
        const auto first = volume * kSiteStride;
        return {{N::load(sites, first), N::load(sites, first + 1), N::load(sites, first + 2)},
                position,
                N::load(inverse_reach, volume)};
    }
    template <class N>
    PL_INLINE DirectionTables<N> tables_of(typename N::Int volume) const {
        return {cells, row_cdf, column_cdf, volume};
    }
    template <class N>
    PL_INLINE Real3<N> normal_of(typename N::Int volume) const {
        return {N::load(normals, 3 * volume), N::load(normals, 3 * volume + 1), N::load(normals, 3 * volume + 2)};
    }
    template <class N>
    PL_INLINE typename N::Real fraction_of(typename N::Int volume) const {
        return bsdf_fraction != nullptr ? N::load(bsdf_fraction, volume) : N::constant(same_bsdf_fraction);
    }
};

/// The table entry that chose, or could have chosen, a direction; or none.
struct TableEntry {
    std::int32_t volume = kNoVolume;
    std::int32_t cell = 0;
    float bsdf_ratio = 1.0f;  ///< density of BSDF sampling over that of the mixture
    float distance = 0.0f;    ///< to what the direction met; 0 before it has met anything
};

struct GuidedSampling {
    FieldView field;
    MixtureSettings mixture{};

    PL_HD GuidedMixture mixture_view() const {
        return {.cells = field.cells,
                .row_cdf = field.row_cdf.data,
                .column_cdf = field.column_cdf.data,
                .normals = &field.normals.data->x,
                .sites = &field.sites.data->position.x,
                .inverse_reach = field.inverse_reach.data,
                .bsdf_fraction = mixture.learned != 0 ? field.bsdf_fraction.data : nullptr,
                .same_bsdf_fraction = mixture.bsdf_fraction};
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
    PL_HD DirectionSample weigh(const GuidedVertex& vertex, const SurfacePoint& surface, Vec3f wi) const {
        if (vertex.volume == kNoVolume) return weigh_lambert(surface, wi);
        return pack(mixture_view().weigh(place_of(vertex, surface), unpack(wi)));
    }

    PL_HD DirectionSample sample_direction(const GuidedVertex& vertex, const SurfacePoint& surface, const Rng& rng,
                                           std::uint32_t index, Vec4f u) const {
        if (vertex.volume == kNoVolume) return weigh_lambert(surface, lambert_sample(surface, {u.y, u.z}));
        const auto draw_jitter = [&] {
            const Vec4f jitter = rng.draw(index, Purpose::CellJitter);
            return Real2<One>{jitter.x, jitter.y};
        };
        return pack(mixture_view().sample(place_of(vertex, surface), u.x, {u.y, u.z}, draw_jitter));
    }

    PL_HD float pdf_sa(const GuidedVertex& vertex, const SurfacePoint& surface, const LayeredBsdf& bsdf,
                       Vec3f wi) const {
        return weigh(vertex, surface, bsdf, wi).pdf_sa;
    }
    PL_HD DirectionSample sample_direction(const GuidedVertex& vertex, const SurfacePoint& surface,
                                           const LayeredBsdf& bsdf, const Rng& rng, std::uint32_t index, Vec4f u,
                                           float choice) const {
        if (vertex.volume == kNoVolume || u.x < mixture_view().bsdf_share(vertex.volume))
            return weigh(vertex, surface, bsdf, bsdf.sample(surface, {u.y, u.z}, choice));
        const Vec4f jitter = rng.draw(index, Purpose::CellJitter);
        const Vec3f wi = mixture_view().sample_table(place_of(vertex, surface), {u.y, u.z}, {jitter.x, jitter.y});
        return weigh(vertex, surface, bsdf, wi);
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

    PL_HD TableEntry entry_of(const GuidedVertex& vertex, const DirectionSample& direction) const {
        if (direction.cell < 0) return {};
        return {vertex.volume, direction.cell, direction.bsdf_pdf_sa / direction.pdf_sa};
    }

    /// Adds an observation of the radiance (luminance) that arrived, if there is an entry for it.
    PL_HD void record_target(const TableEntry& entry, float target) const {
        if (entry.volume == kNoVolume) return;
        record(field, entry.volume, entry.cell, target);
        record_light(entry, target);
    }
    /// What the mixture and the reach learn from it.
    PL_HD void record_light(const TableEntry& entry, float light) const {
        const float weight = light_weight(field, entry.volume, entry.bsdf_ratio, light);
        record_reach(field, entry.volume, weight, entry.distance);
        if (mixture.learned != 0) record_mixture(field, entry.volume, entry.bsdf_ratio, weight);
    }

private:
    PL_HD DirectionSample weigh(const GuidedVertex& vertex, const SurfacePoint& surface, const LayeredBsdf& bsdf,
                                Vec3f wi) const {
        const float bsdf_pdf_sa = bsdf.pdf_sa(surface, wi);
        if (vertex.volume == kNoVolume) return {wi, bsdf_pdf_sa, bsdf_pdf_sa};
        return pack(mixture_view().weigh(place_of(vertex, surface), unpack(wi), bsdf_pdf_sa));
    }
    static PL_HD GuidedPlace<One> place_of(const GuidedVertex& vertex, const SurfacePoint& surface) {
        return {vertex.volume, unpack(surface.position), unpack(surface.shading_normal)};
    }
    static PL_HD DirectionSample pack(const GuidedDirection<One>& direction) {
        return {pl::pack(direction.wi), direction.pdf_sa, direction.bsdf_pdf_sa, direction.cell};
    }
};

}  // namespace pl
