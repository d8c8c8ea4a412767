// The two kinds of paths: camera paths of a picture, and probes that fill the precomputed map before rendering.
#pragma once

#include "core/kernel/film/film_view.h"
#include "core/kernel/integrator/probe.h"
#include "core/session/backend.h"

namespace pl {

/// One path per pixel; adds its radiance to a film.
template <FeatureSet F, class M>
struct PictureWork {
    static constexpr Purpose kStartPurpose = Purpose::Pixel;

    Camera camera;
    std::uint32_t sample = 0;
    FilmView film;

    std::uint32_t count() const { return film.pixels.count; }
    std::uint32_t start_sample() const { return sequence_of(sample); }
    PathState<F, M> begin(std::uint32_t pixel, Vec4f start) const {
        __builtin_prefetch(&film.pixels[pixel], 1);  // films exceed the cache
        return begin_path<F, M>(camera, {film.width, film.height, sample}, pixel, start);
    }
    bool finish(const PathState<F, M>& state, MethodCounters&) const {
        return accumulate(film, state.pixel, state.radiance, sample);
    }
};

/// One probe per cell of every volume; adds its radiance to a table.
template <FeatureSet F>
struct ProbeWork {
    static constexpr Purpose kStartPurpose = Purpose::Probe;

    TableView field;
    ProbeStratum stratum;

    std::uint32_t count() const { return probe_count(field); }
    std::uint32_t start_sample() const { return stratum.index; }
    PathState<F, ProbeMethod> begin(std::uint32_t probe, Vec4f u) const {
        return begin_probe<F>(field, probe, stratum, u);
    }
    bool finish(const PathState<F, ProbeMethod>& state, MethodCounters& counters) const {
        finish_probe(field, state, counters);
        return is_valid_radiance(state.radiance);
    }
};

}  // namespace pl
