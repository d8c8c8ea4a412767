// Where in a picture a method gains or loses: the noise of two pictures, tile by tile, at equal time.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/measure/gain.h"
#include "core/measure/halves.h"

namespace pl {

/// A picture in halves, and the time it took.
struct TimedHalves {
    PictureHalves halves;
    double seconds = 0.0;  ///< charged
};

/// Gains in the time to the same noise, baseline over method: squared noise times seconds of the one over those of the other. The time is
/// that of the whole picture, since all tiles get the same samples.
struct TileGains {
    int columns = 0;
    int rows = 0;
    std::vector<Interval> tiles;  ///< [row][column]
    Interval picture;

    /// The first pixel of column `i` of tiles in a picture of this width; likewise of rows.
    static int edge(int i, int count, int size) { return i * size / count; }
};

/// Columns and rows of tiles at most; tiles are at least kFewestTilePixels wide and high.
inline constexpr int kMostTiles = 8;
inline constexpr int kFewestTilePixels = 16;

/// Noise is that of estimate_noise(), relative to the mean of the surrounding pixels in both pictures together. Intervals are of the
/// jackknife over 32 interleaved sets of pixels: of these two pictures, whatever other seeds would have taught. Throws Error(Input) if
/// sizes differ or `width` does not divide them.
TileGains tile_gains(const TimedHalves& base, const TimedHalves& method, int width);

/// The mark of a verdict: "gains", "loses", "no difference", "undecided".
std::string_view mark_name(Verdict verdict);
/// "gains 1.8x (1.6 to 2.1)", "loses 1.2x (1.1 to 1.3)", "undecided (0.8 to 1.4)": a gain in time with its 95 % interval.
std::string mark_text(const Interval& net);
/// Its color, opaque ARGB.
std::uint32_t mark_color(Verdict verdict);

}  // namespace pl
