#include "ui/window/image_layer.h"

#include "core/base/error.h"
#include "core/diagnose/diagnostics.h"
#include "ui/draw/picture.h"

namespace pl::ui {

Rect ImageLayer::place(const ViewerModel& model, const Rect& view) const {
    const RenderSettings settings = model.frame() != nullptr ? model.frame()->settings : model.render().settings();
    return model.window().zoom.place(view, settings.width, settings.height);
}

/// At a time of the past: the entropy of the volumes at that time; null for the present.
const CellImage* ImageLayer::tint_of(const PublishedFrame& frame, const Key& key) {
    if (key.past == nullptr || key.opacity <= 0.0f || frame.cells == nullptr) return nullptr;
    if (tinted_ == frame.cells && tinted_at_ == key.past) return &tint_;
    std::vector<std::uint32_t> colors;
    for (std::size_t volume = 0; volume < key.past->volumes(); ++volume)
        colors.push_back(cell_color(static_cast<std::int32_t>(volume), cell_table_.view()));
    tint_ = tint_cells(*frame.cells, colors, entropy_shares(*key.past));
    tinted_ = frame.cells;
    tinted_at_ = key.past;
    return &tint_;
}

void ImageLayer::fill(const ViewerModel& model, const Key& key) {
    const PublishedFrame& frame = *model.frame();
    try {
        (void)frame.picture.pixels();  // before locking, which loses the old pixels
    } catch (const Error&) {
        return;  // the device is lost: the render thread reports it and goes on with another one
    }
    CellOverlay overlay{frame.cells.get(), key.opacity, std::nullopt};
    overlay.tint = tint_of(frame, key);
    if (key.selected != kNoVolume) overlay.outlined = cell_color(key.selected, cell_table_.view());
    texture_.fill([&](std::uint32_t* out, std::size_t pitch) {
        write_picture(frame.picture, overlay, out, pitch);
        if (key.diagnostics) diagnose::mark_diagnostics(*key.diagnostics, {out, pitch});
    });
}

void ImageLayer::draw(const ViewerModel& model, const Rect& image, const Rect& view) {
    if (model.frame() == nullptr) return;
    const Snapshot& snapshot = model.frame()->snapshot;
    if (texture_.resize(snapshot.width, snapshot.height)) key_ = {};
    const Key key{model.frame()->serial, model.display().cells() ? model.display().cells_opacity() : 0.0f,
                  model.selection().volume(), model.diagnostics().map(), model.time().shown_frame()};
    if (!(key == key_)) {
        fill(model, key);
        key_ = key;
    }
    texture_.draw(image, common_part(image, view),
                  model.window().zoom.is_whole() ? Scaling::Smooth : Scaling::Nearest);
}

}  // namespace pl::ui
