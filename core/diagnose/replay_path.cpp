#include "core/diagnose/replay_path.h"

#include "core/kernel/geometry/intersector.h"
#include "core/kernel/integrator/sampled_lights.h"
#include "core/kernel/integrator/trace_path.h"

namespace pl::diagnose {
namespace {

/// Samples directions as every guided method does; counts clamped training samples instead of adding them to the field.
template <GuidingField Field>
struct CountingMethod : Guided<Field, ExpectedSarsa> {
    std::uint32_t* clamped = nullptr;  ///< null where training samples differ from the samples of the pass

    void record(const TrainingSample<Field>& sample) const {
        if (clamped == nullptr || !sample.entry.is_trained()) return;
        *clamped += this->field.is_clamped(sample.target) ? 1u : 0u;
    }
    void record_light(const LightSample<Field>&, bool) const {}
};

/// The kernel of all features traces the same bits as the one that rendered the pass.
template <class M>
PathDefects trace_again(const PassReplay& passes, const PathSettings& path, const M& method, std::uint32_t pixel,
                        std::uint32_t sample) {
    const SampledScene sampled = with_delta_lights(passes.scene->view(), path);
    const PixelGrid grid{static_cast<std::uint32_t>(passes.width), static_cast<std::uint32_t>(passes.height), sample};
    auto state = begin_path<kEveryFeature, M>(passes.camera, path, grid, pixel);
    PathCounters counters;
    trace_path<kEveryFeature>(PathContext<M>{sampled.scene, method, sampled.path}, BvhIntersector{sampled.scene},
                              state, counters);
    return {.escapes = static_cast<std::uint32_t>(counters.escaped),
            .lookup_misses = static_cast<std::uint32_t>(counters.method.lookup_misses)};
}

}  // namespace

PathDefects replay_path(const PassReplay& passes, const AnyFieldView& field, std::uint32_t pixel,
                        std::uint32_t pass) {
    std::uint32_t clamped = 0;
    PathDefects defects =
        with_replayed_method<CountingMethod>(passes, field, pass, [&](auto method, const PathSettings& path) {
            if constexpr (requires { method.clamped; }) method.clamped = passes.repeats_training ? &clamped : nullptr;
            return trace_again(passes, path, method, pixel, passes.schedule.sample_of(pass));
        });
    defects.clamped_samples = clamped;
    return defects;
}

}  // namespace pl::diagnose
