#include "ui/model/compare_controls.h"

#include <algorithm>

#include <fmt/format.h>

namespace pl::ui {

void CompareControls::update() {
    const ReferencePicture* reference = references_.current();
    accuracy_.update(link_.worker().runs(), link_.status().picture,
                     reference != nullptr ? reference->noise_relmse : 0.0);
}

CompareInput CompareControls::input() const {
    return {.runs = accuracy_.runs(),
            .picture = link_.status().picture,
            .kind = accuracy_.kind(),
            .cursor = accuracy_.cursor(),
            .reference = references_.current()};
}

ComparePlan CompareControls::plan(const Rect& view, const PictureZoom& zoom) const {
    if (state_.mode == CompareMode::Off || link_.status().picture == 0) return {};
    CompareSides sides;
    if (const auto& turns = link_.turns()) {
        sides = {side_in_turns(input(), (*turns)[0], link_.frame()),
                 side_in_turns(input(), (*turns)[1], link_.second_frame())};
    } else {
        sides = resolve_sides(input(), state_);
        for (auto* side : {&sides.a, &sides.b})
            if (*side) show_newer(**side, link_.frame());
    }
    return plan_comparison(sides, state_, references_.current(), view, zoom);
}

void CompareControls::set_mode(CompareMode mode) {
    state_.mode = mode;
    state_.shows_second = false;
    if (mode == CompareMode::Off) accuracy_.set_cursor({});
}

void CompareControls::step_mode(int steps) { set_mode(stepped(state_.mode, steps)); }

void CompareControls::end() {
    set_turns(false);
    set_mode(CompareMode::Off);
}

void CompareControls::flip() {
    if (state_.mode != CompareMode::Flip) set_mode(CompareMode::Flip);
    state_.shows_second = !state_.shows_second;
}

void CompareControls::choose_side(bool second, const SideChoice& choice) {
    (second ? state_.b : state_.a) = choice;
    if (state_.mode == CompareMode::Off) set_mode(CompareMode::Split);
}

void CompareControls::set_split(float share) { state_.split = std::clamp(share, 0.0f, 1.0f); }

void CompareControls::set_cursor(const Cursor& cursor) {
    accuracy_.set_cursor(cursor);
    if (accuracy_.cursor().kind != Cursor::Kind::None && state_.mode == CompareMode::Off)
        set_mode(CompareMode::Split);
}

/// The baseline; for the baseline itself the method before it, or one that learns.
MethodId CompareControls::other_method() const {
    const MethodId base = baseline_method();
    if (render_.method() != base) return base;
    return render_.previous_method() != base ? render_.previous_method() : learning_method();
}

void CompareControls::set_turns(bool on) {
    if (on == in_turns()) return;
    if (!on) {
        link_.end_turns(render_.method());
        return;
    }
    if (references_.is_making()) {
        messages_.say(MessageLevel::Info, "turns have to wait for the reference: Esc ends it");
        return;
    }
    const TurnMethods methods{render_.method(), other_method()};
    accuracy_.set_cursor({});
    link_.begin_turns(methods);
    if (state_.mode != CompareMode::Flip && state_.mode != CompareMode::SideBySide) set_mode(CompareMode::Split);
    messages_.note(MessageLevel::Info, fmt::format("{} and {} render in turns of equal time",
                                                   info_of(methods[0]).label, info_of(methods[1]).label));
}

}  // namespace pl::ui
