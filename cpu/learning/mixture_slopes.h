// The loss of a mixture that a network gives, times the cosine, and its slopes by the outputs of the network.
#pragma once

#include "core/kernel/base/frame.h"
#include "core/kernel/guiding/vertex_mixture.h"
#include "cpu/base/lane_kernels.h"

namespace pl {

/// Light in the cells of one volume. Arrays: [column], directions in its frame.
struct TaughtLight {
    const float* probability;
    const float *x, *y, *z;
    std::uint32_t columns;
    Vec3f normal;  ///< of the volume, in the frame of the world
};

/// The expected -ln q of the light, q the density of vertex_mixture(), and its slopes times `scale` into slopes[column of the outputs].
///
/// Times the cosine's lobe, exp(k_c (n w - 1)), a lobe of concentration k and mean m has the density exp(b + v w) with v = k m + k_c n,
/// whose integral is exp(b + A(|v|)), A(k) = ln(4 pi sinh(k) / k), and A' is the mean cosine r. So the slope of -ln q by b is the
/// share of the lobe in the mixture minus its responsibility, and that by v is the same difference of mean directions: those of an
/// exponential family.   [Bishop 2006, "Pattern Recognition and Machine Learning", 2.4 and 9.3]
float mixture_slopes(const LaneKernels& kernels, const TaughtLight& light, const float* outputs, float scale,
                     float* slopes);

}  // namespace pl
