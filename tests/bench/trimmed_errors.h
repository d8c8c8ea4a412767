// Errors of a picture without the pixels where they are largest, at any share of these.
#pragma once

#include "core/measure/metrics.h"

namespace pl::benchmarks {

/// The trimmed twins of mse and relmse at another share of left-out pixels.
struct TrimmedErrors {
    double mse = 0.0;
    double relmse = 0.0;
};

/// Means without the `left_out` share, in [0, 1), of the pixels: those farthest from the mean of the halves, for relmse
/// relative to it; their number is rounded down. Squares and finite pixels as in measure_error(), and without halves the
/// same as its twins. With them the order differs: theirs leaves out large products, but only positive ones, so that noise in
/// the reference pulls the rest below the truth. Sorts pixels: for benchmarks, not for pictures that are
/// measured while they are rendered. Throws as measure_error() does.
TrimmedErrors measure_trimmed(Pixels picture, const PictureHalves& reference, double left_out);

}  // namespace pl::benchmarks
