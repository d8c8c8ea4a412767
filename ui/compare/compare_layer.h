// Draws the pictures of a comparison into the window, by textures that are refilled when their content changes.
#pragma once

#include <array>
#include <optional>

#include "ui/compare/compare_plan.h"
#include "ui/compare/half_image.h"
#include "ui/draw/picture.h"
#include "ui/draw/picture_zoom.h"
#include "ui/draw/stream_texture.h"

namespace pl::ui {

class CompareLayer {
public:
    explicit CompareLayer(SDL_Renderer* renderer) : slots_{Slot(renderer), Slot(renderer)} {}

    /// `overlay` lies over each of the pictures.
    void draw(const ComparePlan& plan, const DisplaySettings& display, const CellOverlay& overlay);

    /// The tiles as drawn last, again in the magnifier's box: each as far as it is visible.
    void magnify(const ComparePlan& plan, const Magnifier& magnifier);

private:
    struct Slot {
        explicit Slot(SDL_Renderer* renderer) : texture(renderer) {}
        StreamTexture texture;
        TileContent shown;
        DisplaySettings display;
        CellOverlay overlay;
        bool filled = false;
    };

    /// With the display and overlay of the slot.
    void fill(Slot& slot, const TileContent& content);
    const HalfCodes& codes(const DisplaySettings& display);

    std::array<Slot, 2> slots_;
    std::optional<HalfCodes> codes_;
};

}  // namespace pl::ui
