// A picture of few samples, smoothed for the eye: along surfaces, not over their edges. A display alone: biased, and never a film, an
// error or a file.
#pragma once

#include <span>
#include <vector>

#include "core/inspect/first_hits.h"
#include "core/kernel/base/math.h"

namespace pl {

/// An a-trous wavelet filter of 3 x 3 taps over light without the albedo of the first surfaces [Dammertz, Sewtz, Hanika and Lensch 2010,
/// "Edge-Avoiding A-Trous Wavelet Transform for fast Global Illumination Filtering"].
class Denoiser {
public:
    /// `pixels` are means of `passes` samples. Pixels that are NaN or infinite, and those that see no surface, stay as they are. Valid
    /// until the next call. Incomplete if `stop` is set meanwhile.
    std::span<const Vec3f> denoise(std::span<const Vec3f> pixels, const FirstHits& hits, std::uint32_t passes,
                                   const std::atomic<bool>* stop = nullptr);

private:
    using Plane = std::vector<float>;  ///< [pixel]
    /// Light without albedo.
    struct Light {
        Plane color[3];
        Plane tone;  ///< of the luminance, in [0, 1)
    };

    void resize(std::size_t count);
    void divide_by_albedo(std::span<const Vec3f> pixels, const FirstHits& hits);
    void set_tones(Light& light, std::size_t begin, std::size_t end) const;
    void smooth(const FirstHits& hits, int step, float tolerance);

    Light now_;
    Light next_;
    Plane material_;  ///< FirstHits::material, NaN for pixels that stay
    float mean_ = 1.0f;
    std::vector<Vec3f> smoothed_;
};

}  // namespace pl
