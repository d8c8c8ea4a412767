// The films of the CPU back end.
#pragma once

#include <span>

#include "core/session/film_slots.h"

namespace pl {

class FilmStore {
public:
    /// Allocates the film at this size and clears it. Throws Error if the size is out of range.
    void reset(FilmSlot slot, int width, int height, int threads);

    /// The following functions throw Error if the film was never reset.
    FilmView view(FilmSlot slot, std::uint32_t weight) { return films_.existing(slot).view(weight); }
    FilmReading read(FilmSlot slot, int threads) const;
    FilmReading read_halves(FilmSlot slot, int threads) const;
    std::vector<std::uint32_t> invalid_samples(FilmSlot slot) const;
    void read_pixels(FilmSlot slot, std::uint32_t first, std::span<FilmPixel> pixels) const;
    void write_pixels(FilmSlot slot, std::uint32_t first, std::span<const FilmPixel> pixels);
    DisplayFrame show(FilmSlot slot, const FrameStyle& style, int threads);
    float largest_value(FilmSlot slot, int threads);

private:
    template <bool kHalves>
    FilmReading read(FilmSlot slot, int threads) const;

    mutable FilmSlots<HostArray<FilmPixel>> films_{"CPU"};
    ToneTable table_{ToneCurve::Clamp};  ///< of the latest frame
};

}  // namespace pl
