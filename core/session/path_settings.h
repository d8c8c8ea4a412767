// Settings of a person, as kernels want them: with the thresholds of roulette and splitting that go with a method.
#pragma once

#include "core/kernel/integrator/path.h"
#include "core/session/settings.h"

namespace pl {

PathSettings path_settings(const RenderSettings& settings, MethodId method);

/// Paths of probes: stratified numbers of their own, and the roulette of a method without a field.
PathSettings probe_settings(const RenderSettings& settings, MethodId method);

/// BSDF fractions are learned from the contributions of paths, so a precomputed map keeps the fraction that is set.
MixtureSettings mixture_of(const RenderSettings& settings, MethodId method);

}  // namespace pl
