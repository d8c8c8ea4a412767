#include "core/session/served_kernel.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/kernel_row.h"
#include "core/fields/field_kernels.h"
#include "core/scene/needed_effects.h"
#include "core/session/learned_field.h"

namespace pl {
namespace {

KernelRange range_of(const RenderSettings& settings) {
    if (settings.view != View::Beauty) return kViewRange;
    KernelRange range = KernelRange::Full;
    with_kernel_of(representation_of(settings.field, settings.method), settings.method, settings.field.learning, true,
                   [&]<int kEntry>() { range = TypeAt<kEntry, HostMethodList>::kRange; });
    return range;
}

}  // namespace

FeatureSet needed_features(const HostScene& scene, const RenderSettings& settings) {
    const FeatureSet needed = needed_effects(scene).with(needed_effects(settings.camera));
    const bool is_picture = settings.view == View::Beauty;
    const FeatureSet sampled = needed.with(Feature::NextEventEstimation);
    if (is_picture && settings.next_event) return sampled;
    if (settings.view == View::Direct) return needed;
    // Without light sampling there is no choice among many lights. Delta lights are sampled nevertheless.
    return (is_picture && needed.has(Feature::DeltaLights) ? sampled : needed).without(Feature::ManyLights);
}

ServedKernel served_kernel(std::string_view backend, FeatureSet needed, const RenderSettings& settings) {
    ServedKernel kernel{.served = needed.with(settings.forced_effects)};
    kernel.compiled = kCompiledSets[covering_set(kernel.served, range_of(settings))];
    const std::vector<std::string> effects = effect_names(kernel.compiled);
    const std::string_view does =
        settings.view == View::Beauty ? info_of(settings.method).name : info_of(settings.view).name;
    kernel.name =
        fmt::format("{}/{}/{}", backend, does, effects.empty() ? "base" : fmt::format("{}", fmt::join(effects, "+")));
    return kernel;
}

}  // namespace pl
