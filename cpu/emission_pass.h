// Further camera rays for the emission of lamps whose border crosses a pixel, after a pass has added its samples.
#pragma once

#include "core/kernel/integrator/lamp_borders.h"
#include "cpu/launchers.h"

namespace pl {

/// Arguments of an emission kernel; it visits the pixels of setup.paths.
struct EmissionPass {
    PassSetup setup;
    const BatchTracer& tracer;
    EmissionContext context;
    FilmView film;
};

extern const PassKernels<EmissionPass> kEmissionKernels;

}  // namespace pl
