#include "ui/worker/published_frame.h"

#include "core/session/session.h"

namespace pl::ui {

PublishedFrame frame_of_film(Session& session, FilmSlot slot, const DisplaySettings& display, bool with_values) {
    PublishedFrame frame;
    ShownFilm shown = session.show_film(slot, display);
    frame.picture = std::move(shown.frame);
    frame.range = std::move(shown.range);
    frame.display = display;
    frame.snapshot = with_values ? session.snapshot(slot) : session.summary(slot);
    frame.settings = session.settings_for(slot);
    frame.backend = session.backend();
    frame.description = session.shared_scene();
    frame.scene = session.packed_scene();
    return frame;
}

}  // namespace pl::ui
