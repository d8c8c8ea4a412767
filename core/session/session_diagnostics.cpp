// The part of Session that exports the passes of a picture for diagnosis.
#include <algorithm>

#include "core/base/error.h"
#include "core/scene/pack_scene.h"
#include "core/session/path_settings.h"
#include "core/session/session.h"

namespace pl {

/// With light from far away the scene is open on purpose: escaped paths are not lost.
void Session::note_escapes(FilmSlot slot, const PassCounters& counters) {
    if (counters.path.escaped == 0 || scene_.knows_whether_closed()) return;
    if (needed_features(slot).has_any(features(Feature::Environment, Feature::EnvironmentMap))) return;
    scene_.note_escape(settings_.camera.eye, films_[slot].passes > 0);  // delays no first picture
}

PassReplay Session::pass_replay(FilmSlot slot) const {
    if (slot.view != View::Beauty)
        throw Error(ErrorKind::Usage,
                    "view '" + std::string(info_of(slot.view).name) + "' has no paths to diagnose: show 'beauty'");
    const FilmProgress& state = films_[slot];
    const MethodInfo& method = info_of(slot.method);
    PassReplay source{.width = settings_.width,
                      .height = settings_.height,
                      .samples = state.passes,
                      .next_pixel = state.next_pixel,
                      .scene = scene_.packed(),
                      .path = path_settings(settings_, slot.method),
                      .camera = view_camera(),
                      .is_closed = scene_.is_closed()};
    if (!state.runs.empty()) source.runs = state.runs;
    if (state.counters.invalid_samples > 0) source.invalid = backend_->invalid_samples(slot);
    if (!method.uses_field) return source;
    if (!placement_.is_placed() || !backend_->has_field(slot.method)) return source;  // nothing is rendered yet
    if (method.learns) {
        // The field counts the passes of all pictures and back ends; the last ones are those of this picture.
        source.first_sample = static_cast<std::uint32_t>(
            std::max(field(slot.method).passes, std::uint64_t{state.passes}) - state.passes);
        source.has_moving_tables = true;
        source.repeats_training = settings_.field.learning.target == LearningTarget::ExpectedSarsa;
    }
    source.volumes = placement_.volumes();
    source.shape = placement_.shape();
    source.field = backend_->download_field(slot.method);
    source.mixture = mixture_of(settings_, slot.method);
    source.learning = settings_.field.learning;
    source.unguided_path = path_settings(settings_, baseline_method());
    return source;
}

}  // namespace pl
