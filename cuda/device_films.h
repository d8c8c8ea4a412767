// The films of the CUDA back end, by method and view; each exists only once it was asked for.
#pragma once

#include <array>

#include "core/session/backend.h"
#include "cuda/kernels/kernels.h"
#include "cuda/runtime/device_array.h"

namespace pl::cuda {

class DeviceFilms {
public:
    /// Makes the film exist with this size and empties it. Throws Error if the size makes no sense or does not fit.
    void reset(FilmSlot slot, int width, int height, const Stream& stream);

    /// Throws Error if the film was never reset.
    FilmView view(FilmSlot slot);
    FilmReading read(FilmSlot slot, const Stream& stream) const;

private:
    struct Film {
        int width = 0;
        int height = 0;
        DeviceArray<FilmPixel> pixels;
    };
    const Film& existing(FilmSlot slot) const;

    std::array<Film, FilmSlot::kCount> films_;
    // Kept from one reading to the next: pinned memory is dear to get.
    mutable DeviceArray<Vec3f> means_;
    mutable DeviceArray<FilmTotals> totals_;
    mutable PinnedMemory staging_;
};

}  // namespace pl::cuda
