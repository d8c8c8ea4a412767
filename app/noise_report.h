// The noise of a pixel, and the gain of guidance in a picture, as text and as JSON.
#pragma once

#include <string>

#include "core/diagnose/pixel_noise.h"
#include "core/io/json_file.h"
#include "core/measure/gain.h"

namespace pl {

/// A pixel's noise, and the picture that it belongs to.
struct NoiseOfPicture {
    const diagnose::PixelNoise& noise;
    int width = 0;
    std::uint64_t passes = 0;  ///< that trained the field
};

/// Each method's noise by technique, by bounce and by light, then the gain.
std::string noise_text(const NoiseOfPicture& noise);

/// The members of docs/manual.md, "The noise of a pixel". Intervals are [value, low, high].
Json noise_json(const NoiseOfPicture& noise);

/// The members of docs/manual.md, "Where guiding gains".
Json tile_gains_json(const TileGains& gains);

}  // namespace pl
