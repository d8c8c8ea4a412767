// The method of a past path: the one choice that all ways of tracing it again have in common.
#pragma once

#include "core/kernel/methods/default.h"
#include "core/kernel/methods/guided.h"
#include "core/kernel/methods/targets/expected_sarsa.h"
#include "core/session/pass_replay.h"
#include "core/session/path_settings.h"

namespace pl::diagnose {

/// Whether the path of a sample was sampled by the field.
inline bool is_guided_path(const PassReplay& passes, std::uint32_t sample) {
    return passes.volumes != nullptr && passes.is_guided(sample - passes.first_sample);
}

/// Returns trace(method, path settings) with the method that sampled the path. `GuidedBy<Field>` is a Guided method of any
/// target, which does not change paths; its members that are constant during a pass are set here.
template <template <class> class GuidedBy, class Trace>
auto with_replayed_method(const PassReplay& passes, const AnyFieldView& field, std::uint32_t sample, Trace&& trace) {
    const bool is_guided = is_guided_path(passes, sample);
    PathSettings path = is_guided || !passes.volumes ? passes.path : passes.unguided_path;
    path.sequences = passes.run_of(sample - passes.first_sample).sequences;
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

}  // namespace pl::diagnose
