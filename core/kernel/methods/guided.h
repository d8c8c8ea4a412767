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
    std::uint32_t node = FoundVolume::kUnknown;  ///< of the tree, with the place and normal of the volume
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

/// The volume that serves a path, as a mixture sees it.
template <class N>
struct ServingVolume {
    typename N::Int number;  ///< kNoVolume where none serves; the rest then is any number but NaN
    Real3<N> site, normal;
    typename N::Real inverse_reach;
    typename N::Real bsdf_fraction;  ///< a, in (0, 1]
};

/// Where a path stands.
template <class N>
struct GuidedPlace {
    ServingVolume<N> volume;
    Real3<N> position, shading_normal;
};

/// A direction as the serving volume sees it from its site.
template <class N>
struct SeenDirection {
    TableDirection<N> table;
    typename N::Real steradians;  ///< at the site for one at the point
};

/// q = a p_bsdf + (1-a) p_table, with both densities evaluated whichever of the two chose the direction. A direction
/// weighs at most 1/a times what it weighs under BSDF sampling.   [Veach 1997, 9.2.4; Mueller et al. 2017]
/// Plain pointers, for code that is compiled apart; of at least one volume. sample() is all; its steps are for those who
/// choose many directions at once and ask for the next step's memory in time.
struct GuidedMixture {
    DirectionCells cells;
    const float* row_cdf = nullptr;     ///< [volume][row]
    const float* column_cdf = nullptr;  ///< [volume][row][column]

    /// Draws a direction: `choice` chooses between BSDF and table, u the direction, jitter() two further numbers.
    template <class N, class Jitter>
    PL_INLINE GuidedDirection<N> sample(const GuidedPlace<N>& place, typename N::Real choice, const Real2<N>& u,
                                        Jitter&& jitter) const {
        const typename N::Mask guided = is_guided(place, choice);
        typename N::Int row = N::constant(0);
        if (N::any(guided)) row = sample_row(tables_of(place, guided), u.y);
        return weigh(place, choose(place, row, choice, u, jitter));
    }
    /// A direction with all its densities, as if it had been sampled.
    template <class N>
    PL_INLINE GuidedDirection<N> weigh(const GuidedPlace<N>& place, const Real3<N>& wi) const {
        return weigh(place, wi, look(place, wi));
    }

    /// Whether the table chooses the direction.
    template <class N>
    PL_INLINE typename N::Mask is_guided(const GuidedPlace<N>& place, typename N::Real choice) const {
        return (place.volume.number >= 0) & (choice >= place.volume.bsdf_fraction);
    }
    /// The direction. `row` is sample_row() of u.y where the table chooses, else 0.
    template <class N, class Jitter>
    PL_INLINE Real3<N> choose(const GuidedPlace<N>& place, typename N::Int row, typename N::Real choice,
                              const Real2<N>& u, Jitter&& jitter) const {
        const typename N::Mask guided = is_guided(place, choice);
        Real2<N> square = u;
        if (N::any(guided)) square = select(guided, sample_square(tables_of(place, guided), row, u, jitter()), u);
        const FrameOf<N> frame = make_frame(select(guided, place.volume.normal, place.shading_normal));
        const Real3<N> direction = frame.to_world(square_to_cosine_hemisphere(square));
        return select(guided, parallax_of(place).to_point(direction), direction);
    }
    /// How the volume sees a direction.
    template <class N>
    PL_INLINE SeenDirection<N> look(const GuidedPlace<N>& place, const Real3<N>& wi) const {
        const SiteDirection<N> seen = parallax_of(place).to_site(wi);
        return {TableDirection<N>(make_frame(place.volume.normal).to_local(seen.direction)), seen.steradians};
    }
    /// Its densities.
    template <class N>
    PL_INLINE GuidedDirection<N> weigh(const GuidedPlace<N>& place, const Real3<N>& wi,
                                       const SeenDirection<N>& seen) const {
        return weigh(place, wi, seen, cosine_pdf_sa<N>(dot(wi, place.shading_normal)));
    }
    template <class N>
    PL_INLINE GuidedDirection<N> weigh(const GuidedPlace<N>& place, const Real3<N>& wi, const SeenDirection<N>& seen,
                                       typename N::Real bsdf_pdf_sa) const {
        const typename N::Mask served = place.volume.number >= 0;
        const TableDensity<N> table = table_density(tables_of(place, served), seen.table);
        const auto a = place.volume.bsdf_fraction;
        const auto mixed = a * bsdf_pdf_sa + (1.0f - a) * (table.pdf_sa * seen.steradians);
        return {wi, select(served, mixed, bsdf_pdf_sa), bsdf_pdf_sa, select(served, table.cell, N::constant(-1))};
    }

    /// The table of the serving volume where one is wanted, else of the first one: memory that has surely come already.
    template <class N>
    PL_INLINE DirectionTables<N> tables_of(const GuidedPlace<N>& place, typename N::Mask wanted) const {
        return {cells, row_cdf, column_cdf, select(wanted, place.volume.number, N::constant(0))};
    }
    /// The same where BSDF sampling has another density than that of a Lambert reflector.
    template <class N>
    PL_INLINE GuidedDirection<N> weigh(const GuidedPlace<N>& place, const Real3<N>& wi,
                                       typename N::Real bsdf_pdf_sa) const {
        return weigh(place, wi, look(place, wi), bsdf_pdf_sa);
    }

private:
    template <class N>
    static PL_INLINE Parallax<N> parallax_of(const GuidedPlace<N>& place) {
        return {place.volume.site, place.position, place.volume.inverse_reach};
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
    static constexpr bool kSplitsPaths = true;

    TableField field;
    MixtureSettings mixture{};

    PL_HD GuidedMixture mixture_view() const {
        return {.cells = field.cells, .row_cdf = field.row_cdf.data, .column_cdf = field.column_cdf.data};
    }

    PL_HD ServingVolume<One> serving_volume(std::int32_t number) const {
        const auto index = static_cast<std::uint32_t>(number);
        return serving_volume(number, field.sites[index].position, field.normals[index]);
    }
    /// The same, with the place and normal of the volume from where they are at hand.
    PL_HD ServingVolume<One> serving_volume(std::int32_t number, Vec3f site, Vec3f normal) const {
        const auto index = static_cast<std::uint32_t>(number);
        return {number, unpack(site), unpack(normal), field.inverse_reach[index],
                mixture.learned != 0 ? field.bsdf_fraction[index] : mixture.bsdf_fraction};
    }

    PL_HD GuidedVertex arrive(const SurfacePoint& surface, MethodCounters& counters) const {
        return vertex_of(field.find(surface), counters);
    }
    static PL_HD GuidedVertex vertex_of(const FoundVolume& found, MethodCounters& counters) {
        ++counters.lookups;
        counters.lookup_misses += found.volume == kNoVolume ? 1u : 0u;
        return {found.volume, found.node};
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
        const auto draw_jitter = [&] { return jitter_of(rng, index); };
        return pack(mixture_view().sample(place_of(vertex, surface), u.x, {u.y, u.z}, draw_jitter));
    }

    PL_HD float pdf_sa(const GuidedVertex& vertex, const SurfacePoint& surface, const LayeredBsdf& bsdf,
                       Vec3f wi) const {
        if (vertex.volume == kNoVolume) return bsdf.pdf_sa(surface, wi);
        return weigh(place_of(vertex, surface), surface, bsdf, wi).pdf_sa;
    }
    PL_HD DirectionSample sample_direction(const GuidedVertex& vertex, const SurfacePoint& surface,
                                           const LayeredBsdf& bsdf, const Rng& rng, std::uint32_t index, Vec4f u,
                                           float choice) const {
        if (vertex.volume == kNoVolume) return sample_bsdf(surface, bsdf, u, choice);
        const GuidedMixture tables = mixture_view();
        const GuidedPlace<One> place = place_of(vertex, surface);
        if (!tables.is_guided(place, u.x))
            return weigh(place, surface, bsdf, bsdf.sample(surface, {u.y, u.z}, choice));
        const auto draw_jitter = [&] { return jitter_of(rng, index); };
        const std::int32_t row = sample_row(tables.tables_of(place, true), u.z);
        return weigh(place, surface, bsdf, pl::pack(tables.choose(place, row, u.x, {u.y, u.z}, draw_jitter)));
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
        // No opinion where nothing is expected, and where what is learned is too large for a ratio.
        const float worth = expected / expectation.first;
        return worth < kInfinity ? worth : survival;
    }

    PL_HD TableEntry entry_of(const GuidedVertex& vertex, const DirectionSample& direction) const {
        if (direction.cell < 0) return {};
        return {vertex.volume, direction.cell, direction.bsdf_pdf_sa / direction.pdf_sa};
    }

    /// One more observation is on its way into the tables.
    PL_HD void count_record(float target, MethodCounters& counters) const {
        ++counters.records;
        counters.clamped_records += is_clamped(target, field.radiance_unit) ? 1u : 0u;
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
    static PL_HD Real2<One> jitter_of(const Rng& rng, std::uint32_t index) {
        const Vec4f jitter = rng.draw(index, Purpose::CellJitter);
        return {jitter.x, jitter.y};
    }
    PL_HD DirectionSample weigh(const GuidedPlace<One>& place, const SurfacePoint& surface, const LayeredBsdf& bsdf,
                                Vec3f wi) const {
        return pack(mixture_view().weigh(place, unpack(wi), bsdf.pdf_sa(surface, wi)));
    }
    PL_HD GuidedPlace<One> place_of(const GuidedVertex& vertex, const SurfacePoint& surface) const {
        return {serving_volume(vertex.volume), unpack(surface.position), unpack(surface.shading_normal)};
    }
    static PL_HD DirectionSample pack(const GuidedDirection<One>& direction) {
        return {pl::pack(direction.wi), direction.pdf_sa, direction.bsdf_pdf_sa, direction.cell};
    }
};

}  // namespace pl
