#include "ui/worker/cell_image.h"

#include "ui/worker/cell_colors.h"

namespace pl::ui {

bool CellRenderer::is_current(const Session& session) const {
    return image_pose_ == pose_ && refinement_ == session.refinement();
}

bool CellRenderer::render(Session& session, const StopFlag* stop) {
    if (session.advance(kSlot, stop) != Progress::Rendered) return false;
    image_ = std::make_shared<CellImage>(make_cell_image(session.show_film(kSlot, {}).frame));
    image_pose_ = pose_;
    refinement_ = session.refinement();
    return true;
}

std::shared_ptr<const CellImage> CellRenderer::image(const Session& session) const {
    return is_current(session) ? image_ : nullptr;
}

}  // namespace pl::ui
