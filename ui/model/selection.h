// The surface point, radiance volume and material that a click in the picture selects. Volumes are kept by the point: another field or
// another placement may give them other numbers.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ui/model/display_controls.h"
#include "ui/model/light_tracing.h"
#include "ui/model/messages.h"
#include "ui/model/render_link.h"
#include "ui/worker/render_worker.h"

namespace pl::ui {

/// Radiance volumes that stay in view beside the selected one, each with a color of its own.
class PinnedVolumes {
public:
    static constexpr std::size_t kMost = 4;
    /// 0xAABBGGRR, told apart by most color-blind people.   [Okabe and Ito 2008]
    static constexpr std::array<std::uint32_t, kMost> kColors{0xff009fe6u, 0xffe9b456u, 0xff739e00u, 0xffa779ccu};

    explicit PinnedVolumes(RenderWorker& worker) : worker_(worker) {}

    /// Pins the volume at a place, or unpins it. False if all places are taken.
    bool toggle(std::int32_t volume, const SurfacePlace& at = {}) {
        const auto pinned = std::ranges::find(places_, volume);
        const auto place = pinned != places_.end() ? pinned : std::ranges::find(places_, kNoVolume);
        if (place == places_.end()) return false;
        *place = pinned != places_.end() ? kNoVolume : volume;
        at_[static_cast<std::size_t>(place - places_.begin())] = at;
        send();
        return true;
    }
    void clear() {
        places_.fill(kNoVolume);
        send();
    }
    /// Where the pinned volumes were pinned, by color.
    const std::array<SurfacePlace, kMost>& at() const { return at_; }
    /// The volumes that were pinned there are these now.
    void renumber(std::span<const FoundVolume> found) {
        for (std::size_t pin = 0; pin < kMost; ++pin)
            if (const auto now = std::ranges::find(found, at_[pin], &FoundVolume::at);
                places_[pin] != kNoVolume && now != found.end())
                places_[pin] = now->volume;
        send();
    }

    /// By color; kNoVolume where no volume is pinned.
    const std::array<std::int32_t, kMost>& places() const { return places_; }
    bool is_empty() const { return places_ == kNone; }
    bool contains(std::int32_t volume) const {
        return volume != kNoVolume && std::ranges::find(places_, volume) != places_.end();
    }

private:
    static constexpr std::array<std::int32_t, kMost> kNone{kNoVolume, kNoVolume, kNoVolume, kNoVolume};

    void send() {
        std::vector<std::int32_t> volumes;
        for (const std::int32_t volume : places_)
            if (volume != kNoVolume) volumes.push_back(volume);
        worker_.set_pins(std::move(volumes));
    }

    RenderWorker& worker_;
    std::array<std::int32_t, kMost> places_ = kNone;
    std::array<SurfacePlace, kMost> at_{};
};

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

    /// A click has not been answered yet.
    bool awaits_pick() const { return awaits_pick_; }
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
    PinnedVolumes& pins() { return pins_; }
    const PinnedVolumes& pins() const { return pins_; }
    /// Pins the selected volume, or unpins it.
    void toggle_pin();
    /// A volume by its number, as by a click on it at this place.
    void select_volume(std::int32_t volume, const SurfacePlace& at = {}) {
        at_ = at;
        select(volume);
    }

    const std::optional<std::uint32_t>& material() const { return material_; }
    void select_material(std::uint32_t index) { material_ = index; }
    void drop_material() { material_.reset(); }

    /// Cell of the selected volume's hemisphere under the pointer, or -1.
    int hovered_cell() const { return hovered_cell_; }
    void hover_cell(int cell) { hovered_cell_ = cell; }

private:
    void select(std::int32_t volume);
    void take_pick();
    void find_again();

    RenderLink& link_;
    DisplayControls& display_;
    Messages& messages_;
    std::optional<PickedPoint> picked_;
    std::optional<std::uint32_t> material_;
    std::int32_t volume_ = kNoVolume;
    SurfacePlace at_{};                  ///< where it was selected: it is found there again among other volumes
    std::uint64_t placement_ = 0;        ///< WorkerStatus::placement of the numbers
    std::uint64_t asked_placement_ = 0;  ///< in which the places were last asked for
    int hovered_cell_ = -1;
    bool is_new_ = false;
    bool awaits_pick_ = false;  ///< the newest click has not been taken back
    LightTracing light_;
    PinnedVolumes pins_{link_.worker()};
};

}  // namespace pl::ui
