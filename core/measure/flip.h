// FLIP: the visible difference between two pictures that alternate on a display.   [Andersson et al. 2020]
// Slow beside the other metrics, so it is measured on demand only and never while a clock runs.
#pragma once

#include <vector>

#include "core/measure/metrics.h"

namespace pl {

/// For a display 0.7 m and 3840 pixels wide, viewed from 0.7 m.
inline constexpr double kFlipPixelsPerDegree = 67.0;

/// FLIP of each pixel, [row][column]: 0 for no visible difference, 1 for the largest one. Both pictures are linear
/// and are shown with radiance 0 as black and 1 and above as white (LDR-FLIP); NaN is black. Symmetric. Throws
/// Error(Input) if sizes differ or `width` does not divide them.
std::vector<float> flip_map(Pixels picture, Pixels reference, int width,
                            double pixels_per_degree = kFlipPixelsPerDegree);

/// Mean of a map; 0 if it is empty.
double mean_of(const std::vector<float>& map);

}  // namespace pl
