// Further camera rays for the emission of lamps whose border crosses a pixel, after a pass has added its samples.
#pragma once

#include "core/kernel/film/sample_variance.h"
#include "core/kernel/integrator/lamp_borders.h"
#include "cpu/passes/launchers.h"

namespace pl {

/// Arguments of an emission kernel; setup.paths numbers the pixels of the subset that it visits.
struct EmissionPass {
    PassSetup setup;
    const BatchTracer& tracer;
    EmissionContext context;
    FilmView film;
    PixelSubset subset{};
};

extern const PassKernels<EmissionPass> kEmissionKernels;

}  // namespace pl
