// The films that a back end keeps, by method and view, in its own kind of memory.
#pragma once

#include <array>
#include <string_view>

#include "core/base/error.h"
#include "core/session/backend.h"

namespace pl {

/// `Pixels` holds FilmPixel and offers size() and view_of().
template <class Pixels>
class FilmSlots {
public:
    struct Film {
        int width = 0;
        int height = 0;
        Pixels pixels;  ///< [row][column]; none until the film was first reset

        FilmView view(std::uint32_t weight = 1) {
            return {view_of(pixels), static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), weight};
        }
    };

    explicit FilmSlots(std::string_view owner) : owner_(owner) {}

    Film& at(FilmSlot slot) { return films_[static_cast<std::size_t>(slot.index())]; }

    /// Throws Error if the film was never reset.
    Film& existing(FilmSlot slot) {
        Film& film = at(slot);
        if (film.pixels.size() == 0)
            throw Error(ErrorKind::Runtime,
                        std::string(owner_) + " back end: expected a film, got none: reset it first");
        return film;
    }

private:
    std::string_view owner_;
    std::array<Film, FilmSlot::kCount> films_;
};

}  // namespace pl
