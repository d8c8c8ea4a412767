#include "ui/model/compare_controls.h"

#include <algorithm>

#include <fmt/format.h>

#include "ui/worker/recorder.h"

namespace pl::ui {

void CompareControls::update() {
    const ReferencePicture* reference = references_.current();
    const auto labels = labels_in_turns();
    const auto runs = link_.worker().runs();
    accuracy_.update(runs, link_.status().picture, reference != nullptr ? reference->noise_relmse : 0.0,
                     labels ? base_of_turns(runs->runs, *labels) : std::nullopt, in_turns());
    // In turns each side tells its passes when the other one takes over.
    accuracy_.set_passes(link_.turns() ? 0 : link_.status().passes);
}

CompareInput CompareControls::input() const {
    return {.runs = accuracy_.runs(),
            .picture = link_.status().picture,
            .kind = accuracy_.kind(),
            .cursor = accuracy_.cursor(),
            .reference = references_.current(),
            .file = opened()};
}

ComparePlan CompareControls::plan(const Rect& view, const PictureZoom& zoom) const {
    if (state_.mode == CompareMode::Off || link_.status().picture == 0) return {};
    CompareSides sides;
    if (const auto labels = labels_in_turns()) {
        sides = {side_in_turns(input(), (*labels)[0], link_.frame()),
                 side_in_turns(input(), (*labels)[1], link_.second_frame())};
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

void CompareControls::open_picture(OpenedPicture picture) {
    opened_ = std::move(picture);
    set_turns(false);
    choose_side(true, {SideChoice::What::File, 0});
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

/// The session renders both runs if they differ in the method alone.
TurnSides CompareControls::wanted_turns() const {
    const auto run = state_.b.what == SideChoice::What::Run ? find_run(accuracy_.runs(), state_.b.run) : nullptr;
    if (!run || run->label.picture != accuracy_.picture())
        return {.methods = {render_.method(), other_method()}, .second = nullptr};
    const RenderSettings own = render_.settings();
    const MethodId method = run->label.method;
    TurnSides sides{.methods = {render_.method(), method}, .second = nullptr};
    if (own.next_event != run->settings.next_event || details_of(own, method) != details_of(run->settings, method))
        sides.second = std::make_shared<const RenderSettings>(run->settings);
    return sides;
}

std::optional<std::array<RunLabel, 2>> CompareControls::labels_in_turns() const {
    if (!link_.turns()) return std::nullopt;
    const TurnSides& turns = *link_.turns();
    return std::array{now(), label_of(turns.methods[1], turns.second ? *turns.second : render_.settings())};
}

std::optional<TurnsHeadline> CompareControls::headline() const {
    const auto labels = labels_in_turns();
    if (!labels) return std::nullopt;
    const auto& turns = link_.status().turns;
    std::optional<std::size_t> late;
    if (turns && turns->catching_up) late = turns->seconds[0] < turns->seconds[1] ? 0 : 1;
    return turns_headline(accuracy_.table(), *labels, late);
}

/// Of a run that renders the picture in the window.
RunLabel CompareControls::label_of(MethodId method, const RenderSettings& settings) const {
    return {.method = method,
            .backend = link_.status().backend,
            .next_event = settings.next_event,
            .seed = render_.settings().seed,
            .picture = link_.status().picture,
            .details = details_of(settings, method)};
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
    const TurnSides sides = wanted_turns();
    if (sides.methods[0] == sides.methods[1] && !sides.second) {
        messages_.say(MessageLevel::Info, "the run chosen as B is the present one: choose another, or 'automatic'");
        return;
    }
    accuracy_.set_cursor({});
    link_.begin_turns(sides);
    if (state_.mode != CompareMode::Flip && state_.mode != CompareMode::SideBySide) set_mode(CompareMode::Split);
    const auto labels = *labels_in_turns();
    messages_.note(MessageLevel::Info,
                   fmt::format("{} and {} render in turns of equal time", name_of(labels[0]), name_of(labels[1])));
}

}  // namespace pl::ui
