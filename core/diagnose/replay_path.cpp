#include "core/diagnose/replay_path.h"

#include "core/kernel/geometry/intersector.h"
#include "core/kernel/integrator/trace_path.h"
#include "core/kernel/methods/default.h"
#include "core/kernel/methods/reinforcement.h"

namespace pl {
namespace {

/// Samples directions as every guided method does; counts clamped training samples instead of adding them to the field.
struct CountingMethod : ReinforcementMethod {
    std::uint32_t* clamped = nullptr;  ///< null where training samples differ from those of the pass

    void commit(const Record& learned) const {
        if (clamped == nullptr || learned.volume == kNoVolume) return;
        *clamped += is_clamped(learned.target, field.radiance_unit) ? 1u : 0u;
    }
};

/// The kernel of all features traces the same bits as the one that rendered the pass.
template <class M>
PathDefects trace_again(const PassReplay& passes, const M& method, std::uint32_t pixel, std::uint32_t sample) {
    const SceneView scene = passes.scene->view();
    auto state = begin_path<kEveryFeature, M>(passes.camera, passes.path, static_cast<std::uint32_t>(passes.width),
                                              static_cast<std::uint32_t>(passes.height), pixel, sample);
    PathCounters counters;
    trace_path<kEveryFeature>(scene, BvhIntersector{scene}, method, passes.path, state, counters);
    return {.escapes = static_cast<std::uint32_t>(counters.escaped),
            .lookup_misses = static_cast<std::uint32_t>(counters.method.lookup_misses)};
}

}  // namespace

PathDefects replay_path(const PassReplay& passes, const TableField& field, std::uint32_t pixel,
                        std::uint32_t sample) {
    if (!passes.volumes) return trace_again(passes, DefaultMethod{}, pixel, sample);
    std::uint32_t clamped = 0;
    CountingMethod method;
    method.field = field;
    method.mixture = passes.mixture;
    if (passes.repeats_training) method.clamped = &clamped;
    PathDefects defects = trace_again(passes, method, pixel, sample);
    defects.clamped_samples = clamped;
    return defects;
}

}  // namespace pl
