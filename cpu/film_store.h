// The films of a back end, by method and view; each exists only once it was asked for.
#pragma once

#include <array>
#include <vector>

#include "core/session/backend.h"

namespace pl {

class FilmStore {
public:
    /// Makes the film exist with this size and empties it. Throws Error if the size makes no sense.
    void reset(FilmSlot slot, int width, int height, int threads);

    /// Throws Error if the film was never reset.
    FilmView view(FilmSlot slot);
    FilmReading read(FilmSlot slot, int threads) const;

private:
    struct Film {
        int width = 0;
        int height = 0;
        HostArray<FilmPixel> pixels;
    };
    const Film& existing(FilmSlot slot) const;

    std::array<Film, FilmSlot::kCount> films_;
};

}  // namespace pl
