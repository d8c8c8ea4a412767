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
std::shared_ptr<const CellImage> ImageLayer::tint_of(const ViewerModel& model) {
    const std::shared_ptr<const FieldKeyFrame> past = model.time().shown_frame();
    const auto& cells = model.frame()->cells;
    if (past == nullptr || !model.display().cells() || cells == nullptr) return nullptr;
    if (tinted_ == cells && tinted_at_ == past) return tint_;
    std::vector<std::uint32_t> colors;
    for (std::size_t volume = 0; volume < past->volumes(); ++volume)
        colors.push_back(cell_color(static_cast<std::int32_t>(volume), cell_table_.view()));
    tint_ = std::make_shared<const CellImage>(tint_cells(*cells, colors, entropy_shares(*past)));
    tinted_ = cells;
    tinted_at_ = past;
    return tint_;
}

CellOverlay ImageLayer::overlay(const ViewerModel& model) {
    if (model.frame() == nullptr) return {};
    CellOverlay overlay{.cells = model.frame()->cells,
                        .opacity = model.display().cells() ? model.display().cells_opacity() : 0.0f,
                        .outlined = std::nullopt,
                        .tint = tint_of(model)};
    const std::int32_t selected = model.selection().volume();
    if (selected != kNoVolume) overlay.outlined = cell_color(selected, cell_table_.view());
    return overlay;
}

void ImageLayer::fill(const ViewerModel& model, const Key& key) {
    const PublishedFrame& frame = *model.frame();
    try {
        (void)frame.picture.pixels();  // before locking, which loses the old pixels
    } catch (const Error&) {
        return;  // the device is lost: the render thread reports it and goes on with another one
    }
    texture_.fill([&](std::uint32_t* out, std::size_t pitch) {
        if (shows_heat(frame)) {
            write_heat(frame.snapshot, key.heat, out, pitch);
            write_cells(key.overlay, frame.snapshot.width, frame.snapshot.height, out, pitch);
        } else {
            write_picture(key.is_denoised ? frame.denoised : frame.picture, key.overlay, out, pitch);
        }
        if (key.diagnostics) diagnose::mark_diagnostics(*key.diagnostics, {out, pitch});
    });
}

void ImageLayer::draw(const ViewerModel& model, const Rect& image, const Rect& view) {
    if (model.frame() == nullptr) return;
    const Snapshot& snapshot = model.frame()->snapshot;
    if (texture_.resize(snapshot.width, snapshot.height)) key_ = {};
    const Key key{model.frame()->serial, model.shows_denoised(), overlay(model), model.diagnostics().map(),
                  shows_heat(*model.frame()) ? model.display().heat_range(*model.frame()) : ValueRange{}};
    if (!(key == key_)) {
        fill(model, key);
        key_ = key;
    }
    texture_.draw(image, common_part(image, view),
                  model.window().zoom.is_whole() ? Scaling::Smooth : Scaling::Nearest);
}

}  // namespace pl::ui
