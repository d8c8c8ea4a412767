// A sampled direction, and the numbers it is sampled with: common language of methods, guiding fields and the integrator.
#pragma once

#include "core/kernel/base/rng.h"
#include "core/kernel/scene/surface_point.h"

namespace pl {

/// A direction with its densities per steradian. pdf_sa 0: a zero-valued sample, counted as such.
struct DirectionSample {
    Vec3f wi{0.0f};
    float pdf_sa = 0.0f;       ///< of the method
    float bsdf_pdf_sa = 0.0f;  ///< of BSDF sampling
    std::int32_t bin = -1;     ///< the guiding field's own number for wi (a table's cell); -1 if it has none
};

/// Uniform numbers of one scattering event.
struct ScatterUniforms {
    Rng rng;  ///< of the path: further numbers are drawn by it, with `index` and a purpose of their own
    std::uint32_t index = 0;  ///< PathState::vertices at the vertex
    Vec4f u{0.0f};            ///< x: BSDF or field; y, z: the direction; w: Russian roulette
    float lobe = 0.0f;        ///< chooses among the lobes of a LayeredBsdf
};

/// Density of a field in one direction.
struct FieldDensity {
    float pdf_sa = 0.0f;    ///< per steradian at the surface point
    std::int32_t bin = -1;  ///< see DirectionSample
};

}  // namespace pl
