// The part of Session that diagnostics rest on: whether an escaped path was lost, and the passes to trace again.
#include <algorithm>

#include "core/base/error.h"
#include "core/scene/pack_scene.h"
#include "core/session/session.h"

namespace pl {

/// Whether the scene has an opening matters only once a path has escaped. Light from far away says that it is meant to have
/// one.
void Session::note_escapes(const PassCounters& counters) {
    if (counters.path.escaped == 0 || is_closed_) return;
    if (needed_features().has_any(features(Feature::Environment, Feature::EnvironmentMap))) return;
    // Sorting the edges of a million triangles takes half a second: not before the first picture is there.
    constexpr std::size_t kManyTriangles = 100'000;
    if (!enclosure_ && scene_->triangles.size() > kManyTriangles && film().passes == 0) return;
    if (!enclosure_) enclosure_.emplace(*scene_);
    is_closed_ = enclosure_->contains(settings_.camera.eye);
}

PassReplay Session::pass_replay() const {
    if (settings_.view != View::Beauty)
        throw Error(ErrorKind::Usage, "view '" + std::string(info_of(settings_.view).name) +
                                          "' has no paths to diagnose: show 'beauty'");
    const FilmState& state = film();
    const MethodInfo& method = info_of(settings_.method);
    PassReplay source{.width = settings_.width,
                      .height = settings_.height,
                      .samples = state.passes,
                      .next_pixel = state.next_pixel,
                      .scene = packed_,
                      .path = path_settings(),
                      .camera = make_camera(settings_.camera, settings_.width, settings_.height),
                      .is_closed = is_closed_.value_or(false)};
    if (state.counters.invalid_samples > 0) source.invalid = backend_->invalid_samples(slot());
    if (!method.uses_field) return source;
    if (!volumes_ || !backend_->has_field(settings_.method)) return source;  // nothing was rendered yet
    if (method.learns) {
        // The field's last updates came from these passes, unless another back end rendered some of them.
        source.first_sample =
            static_cast<std::uint32_t>(std::max(field().passes, std::uint64_t{state.passes}) - state.passes);
        source.has_moving_tables = true;
        source.repeats_training =
            is_complete_at_next_vertex(settings_.field.learning, settings_.next_event);
    }
    source.volumes = volumes_;
    source.shape = shape_;
    source.field = backend_->download_field(settings_.method);
    source.mixture = mixture_of(settings_.method);
    return source;
}

}  // namespace pl
