#include "ui/model/selection.h"

#include <utility>

namespace pl::ui {

void Selection::update() {
    light_.update(link_.frame(), inspection(), link_.worker().history());
    const std::optional<PickAnswer> answer = link_.worker().take<PickAnswer>();
    if (!answer || !awaits_pick_) return;
    if (!answer->value) {
        messages_.say(MessageLevel::Info, "nothing to select: the ray leaves the scene");
        return;
    }
    picked_ = answer->value;
    material_ = picked_->material;
    if (picked_->volume == kNoVolume) {
        messages_.say(MessageLevel::Info, "no radiance volume serves this surface: it reflects nothing");
        return;
    }
    select(picked_->volume);
    is_new_ = true;
}

void Selection::select(std::int32_t volume) {
    volume_ = volume;
    hovered_cell_ = -1;
    link_.worker().select_volume(volume);
    display_.set_outline(volume != kNoVolume);
}

void Selection::toggle_pin() {
    if (volume_ == kNoVolume)
        messages_.say(MessageLevel::Info, "click a surface first: the volume there can be pinned");
    else if (!pins_.toggle(volume_))
        messages_.say(MessageLevel::Info, "four volumes are pinned: unpin one first");
}

void Selection::deselect() {
    awaits_pick_ = false;
    picked_.reset();
    select(kNoVolume);
}

bool Selection::take_new_volume() { return std::exchange(is_new_, false); }

const VolumeInspection* Selection::inspection() const {
    const auto& frame = link_.frame();
    const bool fits = frame && frame->volume && frame->volume->volume == volume_ && frame->volume->side > 0;
    return fits ? frame->volume.get() : nullptr;
}

}  // namespace pl::ui
