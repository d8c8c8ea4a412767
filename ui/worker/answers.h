// Answers of the render thread to questions of the window about the session.
#pragma once

#include "core/session/session.h"
#include "ui/worker/published_frame.h"

namespace pl::ui {

/// The surface under a point of the image, in [0,1)^2 from the top left, with the volume that serves it.
PickAnswer answer_pick(Session& session, Vec2f image_point);
/// The volumes that serve these places.
VolumesAnswer answer_volumes(Session& session, const std::vector<SurfacePlace>& places);
/// The learned field of a method, or the reason why there is none.
LearnedAnswer answer_learned(const Session& session, MethodId method);
/// The input of trace_pixel() for a film, or the reason why there is none.
PathsAnswer answer_paths(const Session& session, FilmSlot slot, std::uint64_t generation);
/// The pictures of default and of the guided method of a film, by field_owner(), or the reason why they cannot be compared.
GainAnswer answer_gain(const Session& session, FilmSlot slot);
/// The input of find_diagnostics() for a film, or the reason why there is none. A lost device is such a reason; the
/// next pass fails, too.
DiagnosticsAnswer answer_diagnostics(const Session& session, FilmSlot slot, std::uint64_t generation);

}  // namespace pl::ui
