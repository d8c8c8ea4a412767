// The noise of a pixel, and where in a picture guidance gains: as text, as JSON and as files.
#pragma once

#include <string>

#include "app/console.h"
#include "app/interrupt.h"
#include "app/options.h"
#include "core/diagnose/pixel_noise.h"
#include "core/io/json_file.h"
#include "core/measure/gain.h"
#include "core/session/session.h"

namespace pl {

// The noise of a pixel, and the gain of guidance in a picture, as text and as JSON.

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

// `pathlight trace --why`: the noise of a pixel by technique, bounces and light, and the gain of guidance there.

/// Trains the session, which has to train by every pass, and prints the noise. Returns the exit code.
int trace_noise(Session& session, const Options& options, const InterruptGuard& interrupt, Console& console);

// --gain FILE: where in a picture its method gains or loses against default at equal time.

/// Throws Error(Usage) if --gain is given with a method that has none, or for a file of another kind than .json and .png.
void require_gain(const Options& options);

/// Renders `default` beside the finished picture, in the same session, until it has taken as much time, and writes the file: the gains as
/// JSON, or the picture with a mark for each tile. Returns false if it was interrupted, and writes nothing then.
bool write_gain(Session& session, const Options& options, const InterruptGuard& interrupt, Console& console);

}  // namespace pl
