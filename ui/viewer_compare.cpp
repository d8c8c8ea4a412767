// The part of ViewerModel that compares: runs, the cursors, two pictures, two methods in turns.
#include <algorithm>

#include <fmt/format.h>

#include "ui/viewer_model.h"

namespace pl {

void ViewerModel::take_runs() {
    look_for_reference();
    take_reference();
    const ReferencePicture* found = reference();
    accuracy_.update(worker_.runs(), status_.picture, found != nullptr ? found->noise_relmse : 0.0);
}

CompareInput ViewerModel::compare_input() const {
    return {.runs = accuracy_.runs(),
            .picture = status_.picture,
            .kind = accuracy_.kind(),
            .cursor = accuracy_.cursor(),
            .reference = reference()};
}

CompareSides ViewerModel::sides_in_turns() const {
    const CompareInput input = compare_input();
    return {side_in_turns(input, (*turns_)[0], frame_), side_in_turns(input, (*turns_)[1], turn_frame_)};
}

ComparePlan ViewerModel::compare_plan(const Rect& view) const {
    if (window_.compare.mode == CompareMode::Off || status_.picture == 0) return {};  // or the camera moves
    if (turns_) return plan_comparison(sides_in_turns(), window_.compare, reference(), view);
    CompareSides sides = resolve_sides(compare_input(), window_.compare);
    for (auto* side : {&sides.a, &sides.b})
        if (*side) show_newer(**side, frame_);
    return plan_comparison(sides, window_.compare, reference(), view);
}

void ViewerModel::set_compare_mode(CompareMode mode) {
    window_.compare.mode = mode;
    window_.compare.shows_second = false;
    if (mode == CompareMode::Off) accuracy_.set_cursor({});
}

void ViewerModel::step_compare(int steps) { set_compare_mode(stepped(window_.compare.mode, steps)); }

void ViewerModel::flip() {
    if (window_.compare.mode != CompareMode::Flip) set_compare_mode(CompareMode::Flip);
    window_.compare.shows_second = !window_.compare.shows_second;
}

void ViewerModel::choose_side(bool second, const SideChoice& choice) {
    (second ? window_.compare.b : window_.compare.a) = choice;
    if (window_.compare.mode == CompareMode::Off) set_compare_mode(CompareMode::Split);
}

void ViewerModel::set_split(float share) { window_.compare.split = std::clamp(share, 0.0f, 1.0f); }

void ViewerModel::set_cursor(const Cursor& cursor) {
    accuracy_.set_cursor(cursor);
    if (accuracy_.cursor().kind != Cursor::Kind::None && window_.compare.mode == CompareMode::Off)
        set_compare_mode(CompareMode::Split);
}

void ViewerModel::set_turns(bool on) {
    if (on == turns_.has_value()) return;
    if (on && reference_job_) {
        say(LogLevel::Info, "turns begin when the reference is made: Esc ends it");
        return;
    }
    if (!on) {
        turns_.reset();
        turn_frame_.reset();
        worker_.set_turns(std::nullopt);
        worker_.submit(EditMethod{settings_.method});  // the last turn may have been the other's
        return;
    }
    MethodId other = MethodId::Default;
    if (settings_.method == MethodId::Default)
        other = previous_method_ != MethodId::Default ? previous_method_ : MethodId::Reinforcement;
    turns_ = TurnMethods{settings_.method, other};
    accuracy_.set_cursor({});
    worker_.set_turns(turns_);
    const CompareMode mode = window_.compare.mode;
    if (mode != CompareMode::Flip && mode != CompareMode::SideBySide) set_compare_mode(CompareMode::Split);
    say(LogLevel::Info, fmt::format("{} and {} render in turns of equal time", info_of(settings_.method).label,
                                    info_of(other).label));
}

}  // namespace pl
