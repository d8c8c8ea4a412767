#include "ui/worker/cell_colors.h"

namespace pl::ui {

CellImage make_cell_image(const DisplayFrame& colors) {
    const std::uint32_t* pixels = colors.pixels();
    const auto count = static_cast<std::size_t>(colors.width) * static_cast<std::size_t>(colors.height);
    return {colors.width, colors.height, {pixels, pixels + count}};
}

std::uint32_t cell_color(std::int32_t volume, const ToneCodes& codes) {
    return frame_pixel(color_of_id(static_cast<std::uint32_t>(volume)), {}, codes);
}

}  // namespace pl::ui
