#include "ui/compare/compare_layer.h"

#include <algorithm>

#include "core/base/error.h"

namespace pl::ui {

const HalfCodes& CompareLayer::codes(const DisplaySettings& display) {
    if (!codes_ || !(codes_->display() == display)) codes_.emplace(display);
    return *codes_;
}

void CompareLayer::fill(Slot& slot, const TileContent& content) {
    using What = TileContent::What;
    if (content.what == What::Frame) {
        const DisplayFrame& frame = content.frame->picture;
        try {
            (void)frame.pixels();  // before locking, which loses the old pixels
        } catch (const Error&) {
            return;  // the device is lost: the render thread reports it
        }
        if (slot.texture.resize(frame.width, frame.height)) slot.filled = false;
        slot.texture.fill(
            [&](std::uint32_t* out, std::size_t pitch) { write_picture(frame, slot.overlay, out, pitch); });
        slot.filled = true;
        return;
    }
    const HalfPicture& picture = *content.picture;
    slot.texture.resize(picture.width, picture.height);
    slot.texture.fill([&](std::uint32_t* out, std::size_t pitch) {
        if (content.what == What::Difference)
            write_difference(picture, *content.other, slot.display, out, pitch);
        else if (content.what == What::ErrorMap)
            write_error_map(picture, *content.other, out, pitch);
        else
            write_half_picture(picture, codes(content.is_display ? DisplaySettings{} : slot.display), out, pitch);
        write_cells(slot.overlay, picture.width, picture.height, out, pitch);
    });
    slot.filled = true;
}

void CompareLayer::draw(const ComparePlan& plan, const DisplaySettings& display, const CellOverlay& overlay) {
    for (std::size_t i = 0; i < std::min(plan.tiles.size(), slots_.size()); ++i) {
        const CompareTile& tile = plan.tiles[i];
        Slot& slot = slots_[i];
        if (!slot.filled || !(slot.shown == tile.content) || !(slot.display == display) ||
            !(slot.overlay == overlay)) {
            slot.display = display;
            slot.overlay = overlay;
            fill(slot, tile.content);
            slot.shown = tile.content;
        }
        if (slot.filled)
            slot.texture.draw(tile.place, tile.clip, plan.is_zoomed ? Scaling::Nearest : Scaling::Smooth);
    }
    // Releases the pictures of tiles that are not shown any more.
    for (std::size_t i = plan.tiles.size(); i < slots_.size(); ++i) {
        slots_[i].shown = {};
        slots_[i].overlay = {};
        slots_[i].filled = false;
    }
}

void CompareLayer::magnify(const ComparePlan& plan, const Magnifier& magnifier) {
    for (std::size_t i = 0; i < std::min(plan.tiles.size(), slots_.size()); ++i) {
        const CompareTile& tile = plan.tiles[i];
        const bool is_under = tile.place.x == magnifier.source.x && tile.place.y == magnifier.source.y;
        if (!slots_[i].filled || !is_under) continue;
        // From the window to the magnified picture.
        const auto magnified = [&](Vec2f at) { return window_point(magnifier.image, picture_point(tile.place, at)); };
        const Vec2f low = magnified({tile.clip.x, tile.clip.y});
        const Vec2f high = magnified({tile.clip.x + tile.clip.width, tile.clip.y + tile.clip.height});
        const Rect part = common_part(magnifier.box, {low.x, low.y, high.x - low.x, high.y - low.y});
        slots_[i].texture.draw(magnifier.image, part, Scaling::Nearest);
    }
}

}  // namespace pl::ui
