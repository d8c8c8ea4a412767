// Makes the path settings of kernels from the user's settings, with the threshold of roulette of each method.
#pragma once

#include "core/kernel/integrator/path.h"
#include "core/session/settings.h"

namespace pl {

PathSettings path_settings(const RenderSettings& settings, MethodId method);

/// PassSchedule::ramp of a method's pictures: 1 if it does not learn while it renders.
std::uint32_t weight_ramp(const RenderSettings& settings, MethodId method);

/// Paths of probes: stratified numbers of their own, and the roulette of a method without a field.
PathSettings probe_settings(const RenderSettings& settings, MethodId method);

/// BSDF fractions are learned from the training samples of camera paths, so a precomputed map keeps the fraction of
/// the settings.
MixtureSettings mixture_of(const RenderSettings& settings, MethodId method);

}  // namespace pl
