// Gain of a method over a baseline: its three factors, and a sentence.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/measure/convergence.h"
#include "core/measure/halves.h"

namespace pl {

/// The end of one run.
struct RunEnd {
    double error = 0.0;    ///< squared
    double samples = 0.0;  ///< per pixel
    double seconds = 0.0;  ///< charged, set-up included
    /// Without the share kTrimmedShare of the pixels, the worst ones; NaN if it is not known.
    double trimmed_error = std::numeric_limits<double>::quiet_NaN();

    double error_samples() const { return error * samples; }  ///< variance of one sample
    double error_seconds() const {
        return error * seconds;
    }  ///< inverse efficiency: does not depend on the length of the run
};

/// Ratios above 1 are in favor of the method.
struct Gain {
    Interval samples;        ///< samples of the baseline over samples of the method, for the same error
    Interval cost;           ///< cost of a sample, baseline over method; mostly below 1
    Interval net;            ///< time to the same error, baseline over method: the product of both
    Interval net_trimmed{};  ///< time to the same trimmed error, where it is known
    std::size_t runs = 0;    ///< of the side with fewer
    std::optional<double>
        ahead_from_seconds;               ///< its error stays below from then on; empty if it is above at the end
    double compared_until_seconds = 0.0;  ///< end of the range that both were measured in
};

/// Welch's intervals on logarithms over independent runs. `base` is the baseline.
Gain gain_over(std::span<const RunEnd> base, std::span<const RunEnd> method, std::span<const Curve> base_curves,
               std::span<const Curve> method_curves);

/// Ratios of times between 1 / kEqualFactor and kEqualFactor count as equal.
inline constexpr double kEqualFactor = 1.05;

/// The statement that the 95 % interval of a ratio of times supports.
enum class Verdict {
    Faster,
    Slower,
    NoDifference,  ///< the whole interval counts as equal
    Undecided,     ///< the interval contains 1, or there is none
    Unresolved,    ///< an error is below the resolution of the reference: no ratio
};
Verdict verdict_of(const Interval& ratio);

/// A ratio or its bound with two significant digits, large ones as whole numbers: never "1.4e+02".
std::string ratio_text(double ratio);

/// "1.7x faster", "1.2x slower", "no difference", "undecided", "not resolved".
std::string verdict_text(const Interval& ratio);

/// "needs 3.4x fewer samples than default, each costs 2.0x more: 1.7x faster to the same error (95 %: 1.5 to 1.9),
/// ahead from 2.6 s on". Also states that the method is slower, that there is no difference, that the comparison is
/// undecided, or that there are too few runs.
std::string headline(const Gain& gain, const std::string& base_name);

/// Times from `first` to `last` in equal steps of their logarithm, both included.
std::vector<double> log_spaced(double first, double last, int count);

/// The range of costs in which all runs were measured; empty if there is none.
struct CostRange {
    double first = 0.0;
    double last = 0.0;
};
std::optional<CostRange> common_range(std::span<const Curve> runs);

// Where in a picture a method gains or loses: the noise of two pictures, tile by tile, at equal time.

/// A picture in halves, and the time it took.
struct TimedHalves {
    PictureHalves halves;
    double seconds = 0.0;  ///< charged
};

/// Gains in the time to the same noise, baseline over method: squared noise times seconds of the baseline over
/// squared noise times seconds of the method. The time covers the whole picture, since all tiles get the same
/// samples.
struct TileGains {
    int columns = 0;
    int rows = 0;
    std::vector<Interval> tiles;  ///< [row][column]
    Interval picture;

    /// The first pixel of the `i`-th of `count` columns or rows of tiles, along an axis of `size` pixels.
    static int edge(int i, int count, int size) { return i * size / count; }
};

/// Columns and rows of tiles at most; tiles are at least kFewestTilePixels wide and high.
inline constexpr int kMostTiles = 8;
inline constexpr int kFewestTilePixels = 16;

/// Noise comes from estimate_noise(), relative to the mean of the surrounding pixels in both pictures together.
/// Intervals are of the jackknife over 32 interleaved sets of pixels: of these two pictures, whatever other seeds
/// would have taught. Throws Error(Input) if sizes differ or `width` does not divide them.
TileGains tile_gains(const TimedHalves& base, const TimedHalves& method, int width);

/// The mark of a verdict: "gains", "loses", "no difference", "undecided".
std::string_view mark_name(Verdict verdict);
/// "gains 1.8x (1.6 to 2.1)", "loses 1.2x (1.1 to 1.3)", "undecided (0.8 to 1.4)": a gain in time with its 95 % interval.
std::string mark_text(const Interval& net);
/// Its color, opaque ARGB.
std::uint32_t mark_color(Verdict verdict);

}  // namespace pl
