// The films of the CPU back end.
#pragma once

#include "core/session/film_slots.h"

namespace pl {

class FilmStore {
public:
    /// Makes the film exist with this size and empties it. Throws Error if the size makes no sense.
    void reset(FilmSlot slot, int width, int height, int threads);

    /// Both throw Error if the film was never reset.
    FilmView view(FilmSlot slot) { return films_.existing(slot).view(); }
    FilmReading read(FilmSlot slot, int threads) const;

private:
    mutable FilmSlots<HostArray<FilmPixel>> films_{"CPU"};
};

}  // namespace pl
