// Discrete distributions that are sampled by inversion, with an index of where to search: a search reads few cache lines of a table that
// no cache holds.   [Chen, Asau, On generating random variates from an empirical distribution, AIIE Transactions 6, 1974]
#pragma once

#include "core/kernel/base/numbers.h"
#include "core/kernel/base/span.h"

namespace pl {

/// `count` entries each, one distribution behind the other.
struct IndexedCdf {
    Span<const float>
        values;  ///< [distribution][entry], cumulative probabilities; multiples of 2^-24, the last one 1
    Span<const std::int32_t>
        index;  ///< [distribution][bucket], values but the last one that are not above bucket / buckets
    std::uint32_t count = 0;
    std::uint32_t buckets = 0;  ///< a power of two; each distribution has one more in its index
};

/// The number of values from values[first] on that are not above x, which is known to be in [low, high]; the values ascend.
template <class N>
PL_INLINE typename N::Int search_not_above(const float* values, const typename N::Int& first, typename N::Int low,
                                           typename N::Int high, const typename N::Real& x) {
    for (typename N::Mask open = low < high; N::any(open); open = low < high) {
        const typename N::Int middle = (low + high) >> 1;
        const typename N::Mask is_beyond = open & (N::load(values, first + middle) <= x);
        low = select(is_beyond, middle + 1, low);
        high = select(is_beyond, high, middle);
    }
    return low;
}

/// Place in IndexedCdf::index of the bucket of u in [0, 1).
template <class N>
PL_INLINE typename N::Int bucket_of(const IndexedCdf& cdf, const typename N::Int& distribution,
                                    const typename N::Real& u) {
    return distribution * static_cast<std::int32_t>(cdf.buckets + 1) +
           N::truncate(u * static_cast<float>(cdf.buckets));
}

/// The entry of a discrete distribution whose interval of cumulative probabilities contains a uniform number.
template <class N>
struct CdfSampleOf {
    typename N::Int entry;
    typename N::Real position;  ///< of the number in the interval, in [0, 1]
};
/// Samples the distribution with index `distribution`; u in [0, 1).
template <class N>
PL_INLINE CdfSampleOf<N> sample_cdf(const IndexedCdf& cdf, const typename N::Int& distribution,
                                    const typename N::Real& u) {
    const typename N::Int first = distribution * static_cast<std::int32_t>(cdf.count);
    const typename N::Int bucket = bucket_of<N>(cdf, distribution, u);
    const typename N::Int entry = search_not_above<N>(cdf.values.data, first, N::load(cdf.index.data, bucket),
                                                      N::load(cdf.index.data, bucket + 1), u);
    const typename N::Mask is_first = entry == 0;
    const typename N::Real before = N::load(cdf.values.data, first + select(is_first, entry, entry - 1));
    const typename N::Real start = select(is_first, N::constant(0.0f), before);
    return {entry, (u - start) / (N::load(cdf.values.data, first + entry) - start)};
}

}  // namespace pl
