// The two kinds of paths: camera paths of a picture, and probes that fill the precomputed map before rendering.
#pragma once

#include "core/kernel/film/sample_variance.h"
#include "core/kernel/integrator/probe.h"
#include "core/session/backend.h"
#include "cpu/paths/path_source.h"

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
        return {.seed = path.seed,
                .stream = path.stream,
                .purpose = Purpose::Pixel,
                .sample = sequence_of(sample),
                .subset = subset,
                .pinhole = kPlainFeatures.covers(F) ? &camera : nullptr,
                .grid = grid()};
    }
    PathState<F, M> begin(const PathStart& start) const {
        const std::uint32_t pixel = subset.pixel(start.number);
        prefetch(pixel);  // films exceed the cache
        if constexpr (kPlainFeatures.covers(F))
            return begin_path<F, M>(Ray{.origin = camera.eye, .direction = start.direction}, grid(), pixel);
        else
            return begin_path<F, M>(camera, grid(), pixel, start.u);
    }
    void prefetch(std::uint32_t pixel) const { __builtin_prefetch(&film.pixels[pixel], 1); }
    bool finish(const PathState<F, M>& state, PassCounters& counters) const {
        return use_sample(film, state.pixel, state.radiance, sample, use, counters.variance);
    }

private:
    PixelGrid grid() const { return {film.width, film.height, sample}; }
};

/// One probe per cell of every volume; adds its radiance to a table.
template <FeatureSet F>
struct ProbeWork {
    TableView field;
    ProbeStratum stratum;

    std::uint32_t count() const { return probe_count(field); }
    StartKey start_key(const PathSettings& path) const {
        return {.seed = path.seed, .stream = path.stream, .purpose = Purpose::Probe, .sample = stratum.index};
    }
    PathState<F, ProbeMethod> begin(const PathStart& start) const {
        return begin_probe<F>(field, start.number, stratum, start.u);
    }
    void prefetch(std::uint32_t /*probe*/) const {}
    bool finish(const PathState<F, ProbeMethod>& state, PassCounters& counters) const {
        finish_probe(field, state, counters.path.method);
        return is_valid_radiance(state.radiance);
    }
};

}  // namespace pl
