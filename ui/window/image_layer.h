// The picture in the window: a texture that is refilled from the newest frame when that or an overlay changed.
#pragma once

#include <memory>

#include "ui/draw/picture_zoom.h"
#include "ui/draw/stream_texture.h"
#include "ui/model/viewer_model.h"
#include "ui/worker/cell_image.h"

namespace pl::ui {

class ImageLayer {
public:
    explicit ImageLayer(SDL_Renderer* renderer) : texture_(renderer) {}

    /// The rectangle of the picture within `view`: of the frame in the window, else of the settings.
    Rect place(const ViewerModel& model, const Rect& view) const;

    /// The tint and the outline of the selected volume's cell, as far as they are on.
    CellOverlay overlay(const ViewerModel& model);
    /// The part of the picture in `view`. Nothing before the first frame.
    void draw(const ViewerModel& model, const Rect& image, const Rect& view);
    /// The picture as drawn last, again in the magnifier's box.
    void magnify(const Magnifier& magnifier) { texture_.draw(magnifier.image, magnifier.box, Scaling::Nearest); }

private:
    /// Everything that the texture's pixels depend on.
    struct Key {
        std::uint64_t serial = 0;  ///< of the frame
        bool is_denoised = false;
        CellOverlay overlay{};
        std::shared_ptr<const diagnose::DiagnosticsMap> diagnostics{};
        ValueRange heat{};  ///< of views in heat colors

        friend bool operator==(const Key&, const Key&) = default;
    };

    void fill(const ViewerModel& model, const Key& key);
    std::shared_ptr<const CellImage> tint_of(const ViewerModel& model);

    StreamTexture texture_;
    Key key_;
    ToneTable cell_table_{ToneCurve::Clamp};
    std::shared_ptr<const CellImage> tint_;
    std::shared_ptr<const CellImage> tinted_;         ///< the cells of tint_
    std::shared_ptr<const FieldKeyFrame> tinted_at_;  ///< its time
};

}  // namespace pl::ui
