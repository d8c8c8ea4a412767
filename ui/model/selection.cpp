#include "ui/model/selection.h"

#include <utility>

namespace pl::ui {

void Selection::update() {
    light_.update(link_.frame(), inspection(), link_.worker().history());
    take_pick();
    find_again();
}

void Selection::take_pick() {
    const std::optional<PickAnswer> answer = link_.worker().take<PickAnswer>();
    if (!answer || !awaits_pick_) return;
    awaits_pick_ = false;
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
    asked_placement_ = 0;  // other places are asked for from now on
    if (pins_.is_empty()) placement_ = answer->placement;
    at_ = {picked_->position, picked_->normal};
    select(picked_->volume);
    is_new_ = true;
}

/// Numbers of another placement are asked for by their places.
void Selection::find_again() {
    const auto answer = link_.worker().take<VolumesAnswer>();
    if (answer) {
        placement_ = answer->placement;
        pins_.renumber(answer->value);
        const auto found = std::ranges::find(answer->value, at_, &FoundVolume::at);
        if (volume_ != kNoVolume && found != answer->value.end()) {
            select(found->volume);
            if (volume_ == kNoVolume)
                messages_.say(MessageLevel::Info, "no radiance volume serves the selected point any more");
        }
    }
    const std::uint64_t now = link_.status().placement;
    if (now == placement_ || now == asked_placement_) return;
    if (volume_ == kNoVolume && pins_.is_empty()) {
        placement_ = now;
        return;
    }
    asked_placement_ = now;
    std::vector<SurfacePlace> places(pins_.at().begin(), pins_.at().end());
    places.push_back(at_);
    link_.worker().request_volumes(std::move(places));
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
    else if (!pins_.toggle(volume_, at_))
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
