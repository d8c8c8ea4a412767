// The films of the CUDA back end.
#pragma once

#include <span>

#include "core/session/film_slots.h"
#include "cuda/frame_copies.h"
#include "cuda/kernels/kernels.h"

namespace pl::cuda {

class DeviceFilms {
public:
    /// Allocates the film at this size and clears it. Throws Error if the size is out of range or does not fit.
    void reset(FilmSlot slot, int width, int height, const Stream& stream);

    /// The following functions throw Error if the film was never reset.
    FilmView view(FilmSlot slot, std::uint32_t weight) { return films_.existing(slot).view(weight); }
    FilmReading read(FilmSlot slot, const Stream& stream) const;
    FilmReading read_halves(FilmSlot slot, const Stream& stream) const;
    std::vector<std::uint32_t> invalid_samples(FilmSlot slot, const Stream& stream) const;
    void read_pixels(FilmSlot slot, std::uint32_t first, std::span<FilmPixel> pixels, const Stream& stream) const;
    void write_pixels(FilmSlot slot, std::uint32_t first, std::span<const FilmPixel> pixels, const Stream& stream);
    /// The frame is computed in `stream` and copied in a second stream.
    DisplayFrame show(FilmSlot slot, const FrameStyle& style, const Stream& stream);
    float largest_value(FilmSlot slot, const Stream& stream);

private:
    mutable FilmSlots<DeviceArray<FilmPixel>> films_{"CUDA"};
    /// Reads the mean, followed by the means of the halves; `halves` is 0 or 2.
    FilmReading read(FilmSlot slot, std::uint32_t halves, const Stream& stream) const;

    // Kept between readings: pinned memory is slow to allocate.
    mutable DeviceArray<Vec3f> means_;
    mutable DeviceArray<FilmTotals> totals_;
    mutable PinnedMemory staging_;
    DeviceArray<std::uint32_t> largest_;
    FrameCopies frames_;
};

}  // namespace pl::cuda
