// FLIP: the difference that an eye sees when two pictures take turns on a display.   [Andersson et al. 2020]
// Slow beside the other metrics, so it is measured on demand and never on a clock.
#pragma once

#include <vector>

#include "core/measure/metrics.h"

namespace pl {

/// Of a display 0.7 m and 3840 pixels wide that is looked at from 0.7 m.
inline constexpr double kFlipPixelsPerDegree = 67.0;

/// Per pixel, [row][column]: 0 where no difference is seen, 1 for the largest one. Both pictures are linear and are shown
/// with radiance 0 as black and 1 and above as white (LDR-FLIP); NaN is black. The same both ways round.
/// Throws Error(Input) if sizes differ or `width` does not divide them.
std::vector<float> flip_map(Pixels picture, Pixels reference, int width,
                            double pixels_per_degree = kFlipPixelsPerDegree);

/// Mean of a map; 0 for none.
double mean_of(const std::vector<float>& map);

}  // namespace pl
