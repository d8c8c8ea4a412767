// The watertight triangle test in lanes, of many rays with one triangle or of one ray with many triangles. Included by
// one file per instruction set; see lanes.h.
#pragma once

#include "cpu/lanes/lanes.h"

namespace pl {
namespace {

template <class Real>
PL_INLINE RayVector<float> lane_of(const RayVector<Real>& corner, std::uint32_t lane) {
    return {corner.x[lane], corner.y[lane], corner.z[lane]};
}

/// Mask of the lanes in which two nonzero numbers have the same sign.
template <class Real>
PL_INLINE MaskOf<Real> same_sign(const Real& x, const Real& y) {
    return (std::bit_cast<MaskOf<Real>>(x) ^ std::bit_cast<MaskOf<Real>>(y)) >= 0;
}

/// Recomputes the edge functions exactly in `lanes`, the lanes with a zero among them, as intersect_triangle does,
/// and returns the mask of all lanes with consistent signs. Rare, hence not inlined.
template <class Real>
[[gnu::noinline, gnu::cold]] MaskOf<Real> repeat_exactly(const RayVector<Real>& a, const RayVector<Real>& b,
                                                         const RayVector<Real>& c, std::uint32_t lanes,
                                                         EdgeFunctions<Real>& e) {
    for (; lanes != 0; lanes &= lanes - 1) {
        const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
        const auto pa = lane_of(a, lane);
        const auto pb = lane_of(b, lane);
        const auto pc = lane_of(c, lane);
        e.u[lane] = exact_edge_function(pc, pb);
        e.v[lane] = exact_edge_function(pa, pc);
        e.w[lane] = exact_edge_function(pb, pa);
    }
    const MaskOf<Real> any_negative = (e.u < 0.0f) | (e.v < 0.0f) | (e.w < 0.0f);
    const MaskOf<Real> any_positive = (e.u > 0.0f) | (e.v > 0.0f) | (e.w > 0.0f);
    return ~(any_negative & any_positive) & (e.u + e.v + e.w != 0.0f);
}

/// repeat_exactly() for edge functions in registers: only the rare call puts them into memory.
template <class Real>
PL_INLINE MaskOf<Real> repeat_exactly_in(const RayVector<Real>& a, const RayVector<Real>& b, const RayVector<Real>& c,
                                         std::uint32_t lanes, EdgeFunctions<Real>& e) {
    EdgeFunctions<Real> repeated = e;
    const MaskOf<Real> inside = repeat_exactly(a, b, c, lanes, repeated);
    e = repeated;
    return inside;
}

/// Which lanes' lines cross their triangles, and the edge functions there.
template <class Real>
struct LineTest {
    EdgeFunctions<Real> edges;
    MaskOf<Real> inside;
};

template <class Real>
PL_INLINE LineTest<Real> test_lines(const RayVector<Real>& a, const RayVector<Real>& b, const RayVector<Real>& c) {
    EdgeFunctions<Real> e = edge_functions(a, b, c);
    MaskOf<Real> inside = same_sign(e.u, e.v) & same_sign(e.u, e.w);
    const std::uint32_t zero = mask_bits((e.u == 0.0f) | (e.v == 0.0f) | (e.w == 0.0f));
    if (__builtin_expect(zero != 0, 0)) inside = repeat_exactly_in(a, b, c, zero, e);
    return {e, inside};
}

}  // namespace
}  // namespace pl
