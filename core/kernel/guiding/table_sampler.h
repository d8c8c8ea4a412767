// Sampling directions at surface points from the tables of the volumes that serve them, and the one-sample mixture of
// table and BSDF, for one path or for a vector of paths in lanes.
#pragma once

#include "core/kernel/base/frame.h"
#include "core/kernel/guiding/direction_table.h"
#include "core/kernel/guiding/parallax.h"

namespace pl {

/// A surface point and the volume that serves it; without a volume all members but `volume` are arbitrary finite
/// numbers.
template <class N>
struct ServedPoint {
    typename N::Int volume;  ///< kNoVolume if none serves it
    Real3<N> site, normal;   ///< of the volume
    typename N::Real inverse_reach;
    Real3<N> position;
};

/// The sampling tables of a field with at least one volume, as plain pointers: files that are compiled for one instruction set
/// must not share inline functions with others.
struct TableSampler {
    DirectionCells cells;
    const float* row_cdf = nullptr;     ///< [volume][row]
    const float* column_cdf = nullptr;  ///< [volume][row][column]

    /// Samples a direction; u in [0,1)^2, `row` is sample_row() of u.y.
    template <class N>
    PL_INLINE Real3<N> sample(const ServedPoint<N>& point, typename N::Int row, const Real2<N>& u) const {
        return direction_of(point, sample_square(tables_of<N>(point.volume), row, u));
    }
    /// A direction in coordinates of the volume's table.
    template <class N>
    PL_INLINE TableDirection<N> locate(const ServedPoint<N>& point, const Real3<N>& wi) const {
        const SiteDirection<N> at_site = parallax_of(point).to_site(wi);
        return table_direction<N>(make_frame(point.normal).to_local(at_site.direction), at_site.jacobian);
    }
    /// Density of a direction per steradian at the point, and its cell.
    template <class N>
    PL_INLINE TableDensity<N> density(typename N::Int volume, const TableDirection<N>& direction) const {
        const TableDensity<N> at_site = table_density(tables_of<N>(volume), direction);
        return {at_site.pdf_sa * direction.jacobian, at_site.cell};
    }
    template <class N>
    PL_INLINE DirectionTables<N> tables_of(typename N::Int volume) const {
        return {cells, row_cdf, column_cdf, volume};
    }

    /// World direction at the point, of a point of the table's square.
    template <class N>
    static PL_INLINE Real3<N> direction_of(const ServedPoint<N>& point, const Real2<N>& square) {
        const FrameOf<N> frame = make_frame(point.normal);
        return parallax_of(point).to_point(frame.to_world(square_to_cosine_hemisphere(square)));
    }
    template <class N>
    static PL_INLINE Parallax<N> parallax_of(const ServedPoint<N>& point) {
        return {point.site, point.position, point.inverse_reach};
    }
};

}  // namespace pl
