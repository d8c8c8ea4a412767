// How the picture is displayed: exposure, tone curve, tint by radiance volume, resolution in motion. Nothing here
// restarts a picture.
#pragma once

#include "ui/worker/render_worker.h"

namespace pl::ui {

class DisplayControls {
public:
    static constexpr float kMaxExposureEv = 16.0f;
    static constexpr float kStandardOpacity = 0.4f;

    DisplayControls(const DisplaySettings& settings, RenderWorker& worker) : settings_(settings), worker_(worker) {}

    const DisplaySettings& settings() const { return settings_; }
    void set_exposure(float ev);  ///< in stops
    void set_curve(ToneCurve curve);

    /// The tint that shows which radiance volume serves a pixel.
    bool cells() const { return cells_; }
    void set_cells(bool on);
    float cells_opacity() const { return cells_opacity_; }
    void set_cells_opacity(float opacity);
    /// Whether the selected volume's outline is drawn, which needs the image of the volumes' cells like the tint.
    void set_outline(bool on);

    /// Coarser pictures while the camera moves.
    bool low_resolution() const { return low_resolution_; }
    void set_low_resolution(bool allowed);
    /// Then also a preview in place of a picture without light samples; see MotionPreview.
    bool preview() const { return preview_; }
    void set_preview(bool allowed);

private:
    DisplaySettings settings_;
    RenderWorker& worker_;
    bool cells_ = false;
    bool outline_ = false;
    float cells_opacity_ = kStandardOpacity;
    bool low_resolution_ = true;
    bool preview_ = true;
};

}  // namespace pl::ui
