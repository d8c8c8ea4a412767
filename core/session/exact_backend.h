// Back ends whose state can be taken out and put back to the bit: for checkpoints, and for a driver that spreads passes over
// processes. Apart from backend.h, which the kernels of the CPU include.
#pragma once

#include <functional>
#include <span>

#include "core/base/error.h"
#include "core/session/backend.h"

namespace pl {

class ExactBackend : public RenderBackend {
public:
    /// Pixels of a film from `first` on, row by row: all that the film holds of them.
    virtual void read_pixels(FilmSlot slot, std::uint32_t first, std::span<FilmPixel> pixels) const = 0;
    /// Replaces pixels of a film that has been reset to its size.
    virtual void write_pixels(FilmSlot slot, std::uint32_t first, std::span<const FilmPixel> pixels) = 0;

    /// Calls change(array) for every array of a method's pending sums, and keeps the values that it leaves there.
    virtual void change_pending(MethodId method, const std::function<void(PendingSums)>& change) = 0;

    /// From now on a pass that is stopped leaves no path under way: film and field are all of its state.
    virtual void settle_when_stopped() {}
};

/// Throws Error(Unavailable) if the state of the back end cannot be taken out.
inline ExactBackend& exact(RenderBackend& backend) {
    if (auto* const found = dynamic_cast<ExactBackend*>(&backend)) return *found;
    throw Error(ErrorKind::Unavailable,
                "back end '" + backend.info().name +
                    "': its films cannot be taken out, which a checkpoint needs: expected cpu or cuda");
}

}  // namespace pl
