// The distribution of a picture's luminance, on a logarithmic scale.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "core/kernel/base/math.h"

namespace pl::ui {

/// Counts of pixels by the binary logarithm of their luminance.
struct LuminanceHistogram {
    static constexpr float kLow = -14.0f;  ///< binary logarithm of the luminance at the lower end of bin 0
    static constexpr float kHigh = 14.0f;  ///< at the upper end of the last bin
    static constexpr int kBins = 112;      ///< a quarter of a stop each

    std::array<std::uint32_t, kBins> counts{};
    std::uint32_t pixels = 0;   ///< looked at
    std::uint32_t dark = 0;     ///< of these, black or below the lowest bin
    std::uint32_t bright = 0;   ///< above the highest bin
    std::uint32_t invalid = 0;  ///< NaN or infinite

    /// Of pixels with a place in the counts.
    std::uint32_t counted() const { return pixels - dark - bright - invalid; }
    /// Binary logarithm of the luminance below which a share of the counted pixels lies, by linear interpolation inside its bin.
    /// Empty if none is counted.
    std::optional<float> percentile(float share) const;
    /// Mean of the logarithm over the counted pixels between two percentiles; empty if none is counted.
    std::optional<float> mean(float low_share, float high_share) const;
};

/// Looks at no more than `most` pixels, evenly spread.
LuminanceHistogram make_histogram(std::span<const Vec3f> pixels, std::size_t most = 1u << 16);

/// The exposure in stops at which the mean logarithm of the luminance, without the darkest and the brightest twentieth of the
/// pixels, is that of a gray of 0.18 [Reinhard et al. 2002, "Photographic Tone Reproduction for Digital Images", eq. 1, 2]. Empty
/// for a black picture.
std::optional<float> automatic_exposure(const LuminanceHistogram& histogram);

}  // namespace pl::ui
