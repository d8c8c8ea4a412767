#include "ui/model/display_controls.h"

#include <algorithm>

namespace pl::ui {

void DisplayControls::set_exposure(float ev) {
    settings_.exposure_ev = std::clamp(ev, -kMaxExposureEv, kMaxExposureEv);
    worker_.set_display(settings_);
}

void DisplayControls::set_curve(ToneCurve curve) {
    settings_.curve = curve;
    worker_.set_display(settings_);
}

void DisplayControls::set_cells(bool on) {
    cells_ = on;
    worker_.set_cells_wanted(cells_ || outline_);
}

void DisplayControls::set_cells_opacity(float opacity) { cells_opacity_ = std::clamp(opacity, 0.0f, 1.0f); }

void DisplayControls::set_outline(bool on) {
    outline_ = on;
    worker_.set_cells_wanted(cells_ || outline_);
}

void DisplayControls::set_low_resolution(bool allowed) {
    low_resolution_ = allowed;
    worker_.set_low_resolution_allowed(allowed);
}

void DisplayControls::set_preview(bool allowed) {
    preview_ = allowed;
    worker_.set_preview_allowed(allowed);
}

}  // namespace pl::ui
