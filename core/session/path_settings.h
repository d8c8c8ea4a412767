// The path settings of kernels from those of the user, with the thresholds of roulette and splitting of each method.
#pragma once

#include "core/kernel/film/pass_weights.h"
#include "core/kernel/integrator/path.h"
#include "core/session/settings.h"

namespace pl {

PathSettings path_settings(const RenderSettings& settings, MethodId method);

/// The same for a pass of a learning method whose field was trained by `passes` passes. The first ones split no paths: by the
/// estimates of a field that knows little nearly all would be, in dark places without end.
PathSettings at_pass(PathSettings path, std::uint64_t passes);
/// Whether at_pass() differs from the settings of later passes.
bool has_early_settings(std::uint64_t passes);

/// The weights of a method's passes in a picture, by the number of passes that its field was trained by.
PassWeights pass_weights(const RenderSettings& settings, MethodId method);

/// Paths of probes: stratified numbers of their own, and the roulette of a method without a field.
PathSettings probe_settings(const RenderSettings& settings, MethodId method);

/// BSDF fractions are learned from the training samples of camera paths, so a precomputed map keeps the fraction of
/// the settings.
MixtureSettings mixture_of(const RenderSettings& settings, MethodId method);

}  // namespace pl
