// The two kinds of paths: those of a picture, and those that fill a radiance map before rendering.
#pragma once

#include "core/kernel/film/film_view.h"
#include "core/kernel/integrator/probe.h"
#include "core/session/backend.h"

namespace pl {

/// One path per pixel, into a film.
template <class M>
struct PictureWork {
    PinholeCamera camera;
    PathSettings path;
    std::uint32_t sample = 0;
    FilmView film;

    std::uint32_t count() const { return film.pixels.count; }
    PathState<M> begin(std::uint32_t pixel) const {
        return begin_path<M>(camera, path, film.width, film.height, pixel, sample);
    }
    bool finish(const PathState<M>& state) const { return accumulate(film, state.pixel, state.radiance); }
};

/// One path per cell of every volume, into a table.
struct ProbeWork {
    FieldView field;
    PathSettings path;
    std::uint32_t sample = 0;
    std::uint32_t strata_side = 1;

    std::uint32_t count() const {
        return field.normals.count * static_cast<std::uint32_t>(field.cells.count());
    }
    PathState<DefaultMethod> begin(std::uint32_t probe) const {
        return begin_probe(field, path, probe, sample, strata_side);
    }
    bool finish(const PathState<DefaultMethod>& state) const {
        finish_probe(field, state);
        return is_valid_radiance(state.radiance);
    }
};

} // namespace pl
