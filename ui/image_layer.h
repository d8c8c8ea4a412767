// The picture in the window: one streaming texture, filled from the newest frame when something changed.
#pragma once

#include <memory>

#include "ui/layout.h"
#include "ui/picture.h"
#include "ui/stream_texture.h"
#include "ui/viewer_model.h"

namespace pl {

class ImageLayer {
public:
    explicit ImageLayer(SDL_Renderer* renderer) : texture_(renderer) {}

    /// Where the picture is within `view`: that of the frame in the window, else that of the settings.
    Rect place(const ViewerModel& model, const Rect& view) const;

    /// Draws it. Does nothing before the first frame.
    void draw(const ViewerModel& model, const Rect& image);

private:
    /// All that decides the texture's pixels.
    struct Key {
        std::uint64_t serial = 0;  ///< of the frame
        float opacity = 0.0f;
        std::int32_t selected = kNoVolume;
        std::shared_ptr<const DiagnosticsMap> diagnostics{};

        friend bool operator==(const Key&, const Key&) = default;
    };

    void fill(const ViewerModel& model, const Key& key);

    StreamTexture texture_;
    Key key_;
    ToneTable cell_table_{ToneCurve::Clamp};
};

}  // namespace pl
