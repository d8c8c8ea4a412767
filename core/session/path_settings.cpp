#include "core/session/path_settings.h"

namespace pl {
namespace {

/// Guided paths have a learned contribution estimate and soon end at a light. They play roulette only below a fifth
/// of the contribution expected at their first vertex, so that few of them end before they reach a light; other paths
/// play at every vertex. Lower thresholds leave a little less noise for the same samples and more for the same time
/// (docs/notebook/2026-11-22-roulette-and-splitting.md).
constexpr float kGuidedRouletteThreshold = 0.2f;
/// The same with light samples: a path that ends has had some of the light at each of its vertices
/// (docs/notebook/2026-11-23-guiding-choice.md).
constexpr float kLightSampledRouletteThreshold = 0.35f;

/// Number of the pass from which on passes of a learning method have their full weight, without and with light samples. First passes
/// have many times the variance of later passes, with light samples fewer times; longer ramps waste more of the later passes
/// (docs/notebook/2026-11-23-first-passes.md).
constexpr std::uint32_t kWeightRamp = 8;
constexpr std::uint32_t kLightSampledWeightRamp = 4;

}  // namespace

PathSettings path_settings(const RenderSettings& settings, MethodId method) {
    const float guided_threshold = settings.next_event ? kLightSampledRouletteThreshold : kGuidedRouletteThreshold;
    const bool has_roulette = settings.roulette != kNoRoulette;
    const auto depth = static_cast<std::uint32_t>(settings.max_depth);
    return {.seed = settings.seed,
            .max_depth = depth,
            .roulette_start = has_roulette ? PathSettings{}.roulette_start : depth + 1,
            .roulette_threshold = info_of(method).uses_field ? guided_threshold : 1.0f,
            .roulette = has_roulette ? settings.roulette : RouletteRule::Albedo,
            .next_event = settings.next_event ? 1u : 0u};
}

std::uint32_t weight_ramp(const RenderSettings& settings, MethodId method) {
    if (!info_of(method).learns) return 1;
    return settings.next_event ? kLightSampledWeightRamp : kWeightRamp;
}

PathSettings probe_settings(const RenderSettings& settings, MethodId method) {
    PathSettings path = path_settings(settings, method);
    path.stream = Stream::Precompute;
    path.roulette_threshold = 1.0f;
    return path;
}

MixtureSettings mixture_of(const RenderSettings& settings, MethodId method) {
    MixtureSettings mixture = settings.mixture;
    if (!info_of(method).learns) mixture.learned = 0;
    return mixture;
}

}  // namespace pl
