// The surface point, radiance volume and material that a click in the picture selects.
#pragma once

#include <optional>

#include "ui/model/display_controls.h"
#include "ui/model/light_tracing.h"
#include "ui/model/messages.h"
#include "ui/model/pinned_volumes.h"
#include "ui/model/render_link.h"

namespace pl::ui {

class Selection {
public:
    Selection(RenderLink& link, DisplayControls& display, Messages& messages)
        : link_(link), display_(display), messages_(messages) {}

    /// Selects the surface point under a point of the image, in [0,1)^2 from the top left; the render thread answers
    /// later.
    void pick(Vec2f image_point) {
        link_.worker().request_pick(image_point);
        awaits_pick_ = true;
    }
    /// Takes the render thread's answer; once per frame of the window.
    void update();

    const std::optional<PickedPoint>& picked() const { return picked_; }
    /// kNoVolume if none is selected.
    std::int32_t volume() const { return volume_; }
    /// The inspection of the selected volume's hemisphere; null until the render thread has made it.
    const VolumeInspection* inspection() const;
    /// The light that reaches the volume.
    LightTracing& light() { return light_; }
    const LightTracing& light() const { return light_; }
    /// True once after a click has selected a volume.
    bool take_new_volume();
    /// The point and the volume, also of a click that is not answered yet; the material stays.
    void deselect();
    /// The volume and the pinned ones, because their numbers may be invalid.
    void drop_volume() {
        pins_.clear();
        select(kNoVolume);
    }
    PinnedVolumes& pins() { return pins_; }
    const PinnedVolumes& pins() const { return pins_; }
    /// Pins the selected volume, or unpins it.
    void toggle_pin();
    /// A volume by its number, as by a click on it.
    void select_volume(std::int32_t volume) { select(volume); }

    const std::optional<std::uint32_t>& material() const { return material_; }
    void select_material(std::uint32_t index) { material_ = index; }
    void drop_material() { material_.reset(); }

    /// Cell of the selected volume's hemisphere under the pointer, or -1.
    int hovered_cell() const { return hovered_cell_; }
    void hover_cell(int cell) { hovered_cell_ = cell; }

private:
    void select(std::int32_t volume);

    RenderLink& link_;
    DisplayControls& display_;
    Messages& messages_;
    std::optional<PickedPoint> picked_;
    std::optional<std::uint32_t> material_;
    std::int32_t volume_ = kNoVolume;
    int hovered_cell_ = -1;
    bool is_new_ = false;
    bool awaits_pick_ = false;  ///< the newest click has not been taken back
    LightTracing light_;
    PinnedVolumes pins_{link_.worker()};
};

}  // namespace pl::ui
