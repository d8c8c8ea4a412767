#include "ui/worker/cell_image.h"

namespace pl::ui {

CellImage make_cell_image(const DisplayFrame& colors) {
    const std::uint32_t* pixels = colors.pixels();
    const auto count = static_cast<std::size_t>(colors.width) * static_cast<std::size_t>(colors.height);
    return {colors.width, colors.height, {pixels, pixels + count}};
}

std::uint32_t cell_color(std::int32_t volume, const ToneCodes& codes) {
    return frame_pixel(color_of_id(static_cast<std::uint32_t>(volume)), {}, codes);
}

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
