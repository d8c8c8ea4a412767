// The two kinds of paths: camera paths of a picture, and probes that fill the precomputed map before rendering.
#pragma once

#include "core/kernel/film/sample_variance.h"
#include "core/kernel/integrator/probe.h"
#include "core/session/backend.h"
#include "cpu/path_source.h"

namespace pl {

/// One path per pixel of a subset; adds its radiance to a film.
template <FeatureSet F, class M>
struct PictureWork {
    Camera camera;
    std::uint32_t sample = 0;
    FilmView film;
    SampleUse use = SampleUse::Film;
    PixelSubset subset{};

    std::uint32_t count() const { return subset.count(film.pixels.count); }
    StartKey start_key(const PathSettings& path) const {
        return {path.seed, path.stream, Purpose::Pixel, sequence_of(sample), subset};
    }
    PathState<F, M> begin(std::uint32_t number, Vec4f start) const {
        const std::uint32_t pixel = subset.pixel(number);
        __builtin_prefetch(&film.pixels[pixel], 1);  // films exceed the cache
        return begin_path<F, M>(camera, {film.width, film.height, sample}, pixel, start);
    }
    bool finish(const PathState<F, M>& state, PassCounters& counters) const {
        return use_sample(film, state.pixel, state.radiance, sample, use, counters.variance);
    }
};

/// One probe per cell of every volume; adds its radiance to a table.
template <FeatureSet F>
struct ProbeWork {
    TableView field;
    ProbeStratum stratum;

    std::uint32_t count() const { return probe_count(field); }
    StartKey start_key(const PathSettings& path) const {
        return {path.seed, path.stream, Purpose::Probe, stratum.index};
    }
    PathState<F, ProbeMethod> begin(std::uint32_t probe, Vec4f u) const {
        return begin_probe<F>(field, probe, stratum, u);
    }
    bool finish(const PathState<F, ProbeMethod>& state, PassCounters& counters) const {
        finish_probe(field, state, counters.path.method);
        return is_valid_radiance(state.radiance);
    }
};

}  // namespace pl
