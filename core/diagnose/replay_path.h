// One path of a past pass, traced again: scene, camera, pixel and sample number decide a path, so that all its
// vertices are the same to the bit, unless the field it samples from has been updated since.
#pragma once

#include <cstdint>

#include "core/kernel/methods/default.h"
#include "core/kernel/methods/guided.h"
#include "core/kernel/methods/targets/expected_sarsa.h"
#include "core/session/pass_replay.h"
#include "core/session/path_settings.h"

namespace pl::diagnose {

// The method of a past path: the one choice that all ways of tracing it again have in common.

/// Whether the paths of a pass were sampled by the field.
inline bool is_guided_path(const PassReplay& passes, std::uint32_t pass) {
    return passes.volumes != nullptr && passes.is_guided(pass);
}

/// Returns trace(method, path settings) with the method that sampled the paths of a pass. `GuidedBy<Field>` is a Guided method of any
/// target, which does not change paths; its members that are constant during a pass are set here.
template <template <class> class GuidedBy, class Trace>
auto with_replayed_method(const PassReplay& passes, const AnyFieldView& field, std::uint32_t pass, Trace&& trace) {
    const bool is_guided = is_guided_path(passes, pass);
    PathSettings path = is_guided || !passes.volumes ? passes.path : passes.unguided_path;
    path.sequences = passes.run_of(pass).sequences;
    if (!is_guided) return trace(DefaultMethod{}, path);
    return visit_field(field, [&](const auto& view) {
        using Field = std::remove_cvref_t<decltype(view)>;
        GuidedBy<Field> method;
        static_cast<Field&>(method.field) = view;
        method.mixture = passes.mixture;
        method.learning = passes.learning;
        return trace(method, path);
    });
}

/// Defects on one path.
struct PathDefects {
    std::uint32_t escapes = 0;
    std::uint32_t lookup_misses = 0;
    std::uint32_t clamped_samples = 0;  ///< 0 unless PassReplay::repeats_training
};

/// Runs the kernel's own loop, trace_path(), on the CPU. `field` is the view of PassReplay::field; empty for methods without
/// one.
PathDefects replay_path(const PassReplay& passes, const AnyFieldView& field, std::uint32_t pixel, std::uint32_t pass);

}  // namespace pl::diagnose
