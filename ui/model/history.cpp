#include "ui/model/history.h"

#include <algorithm>
#include <array>
#include <optional>
#include <tuple>

#include <fmt/format.h>

#include "core/fields/field_choices.h"
#include "core/session/choices.h"
#include "ui/draw/value_text.h"
#include "ui/model/viewer_model.h"

namespace pl::ui {
namespace {

auto camera_values(const CameraDescription& c) {
    return std::tuple(c.eye, c.target, c.up, c.fov_deg, c.aperture_radius, c.focus_distance, c.shift);
}

/// One kind of choice.
struct Kind {
    bool (*is_same)(const Choices&, const Choices&);
    std::string (*name)(const Choices&);
    void (*apply)(ViewerModel&, const Choices&);
    bool merges = false;  ///< changes in small steps
};

// The first kind that has changed names a change.
constexpr std::array kKinds{
    Kind{[](const Choices& a, const Choices& b) { return a.settings.method == b.settings.method; },
         [](const Choices& c) { return fmt::format("method {}", info_of(c.settings.method).label); },
         [](ViewerModel& m, const Choices& c) { m.render().set_method(c.settings.method); }},
    Kind{[](const Choices& a, const Choices& b) { return a.settings.view == b.settings.view; },
         [](const Choices& c) { return fmt::format("view {}", info_of(c.settings.view).label); },
         [](ViewerModel& m, const Choices& c) { m.render().set_view(c.settings.view); }},
    Kind{[](const Choices& a, const Choices& b) { return a.settings.next_event == b.settings.next_event; },
         [](const Choices& c) { return std::string(light_samples_text(c.settings.next_event)); },
         [](ViewerModel& m, const Choices& c) { m.render().set_next_event(c.settings.next_event); }},
    Kind{[](const Choices& a, const Choices& b) { return a.settings.roulette == b.settings.roulette; },
         [](const Choices& c) { return fmt::format("roulette: {}", label_of(c.settings.roulette)); },
         [](ViewerModel& m, const Choices& c) { m.render().set_roulette(c.settings.roulette); }},
    Kind{[](const Choices& a, const Choices& b) { return a.settings.guiding == b.settings.guiding; },
         [](const Choices& c) { return fmt::format("guiding: {}", label_of(c.settings.guiding)); },
         [](ViewerModel& m, const Choices& c) { m.render().set_guiding(c.settings.guiding); }},
    Kind{[](const Choices& a, const Choices& b) { return a.settings.max_depth == b.settings.max_depth; },
         [](const Choices& c) { return fmt::format("depth {}", c.settings.max_depth); },
         [](ViewerModel& m, const Choices& c) { m.render().set_max_depth(c.settings.max_depth); }, true},
    Kind{[](const Choices& a, const Choices& b) { return a.settings.seed == b.settings.seed; },
         [](const Choices& c) { return fmt::format("seed {}", c.settings.seed); },
         [](ViewerModel& m, const Choices& c) { m.render().set_seed(c.settings.seed); }, true},
    Kind{[](const Choices& a, const Choices& b) { return a.settings.mixture == b.settings.mixture; },
         [](const Choices&) { return std::string("sampled shares"); },
         [](ViewerModel& m, const Choices& c) { m.render().set_mixture(c.settings.mixture); }, true},
    Kind{[](const Choices& a, const Choices& b) { return a.settings.field == b.settings.field; },
         [](const Choices& c) { return fmt::format("field {}", label_of(c.settings.field.representation)); },
         [](ViewerModel& m, const Choices& c) { m.render().set_field(c.settings.field); }, true},
    Kind{[](const Choices& a, const Choices& b) {
             return a.settings.width == b.settings.width && a.settings.height == b.settings.height;
         },
         [](const Choices& c) { return fmt::format("size {}x{}", c.settings.width, c.settings.height); },
         [](ViewerModel& m, const Choices& c) { m.render().set_size(c.settings.width, c.settings.height); }},
    Kind{[](const Choices& a, const Choices& b) { return a.display == b.display; },
         [](const Choices& c) {
             return fmt::format("exposure {:+.2f} EV, {}", c.display.exposure_ev, label_of(c.display.curve));
         },
         [](ViewerModel& m, const Choices& c) {
             m.display().set_exposure(c.display.exposure_ev);
             m.display().set_curve(c.display.curve);
         },
         true},
    Kind{[](const Choices& a, const Choices& b) { return a.knobs == b.knobs; },
         [](const Choices&) { return std::string("knob of the scene"); },
         [](ViewerModel& m, const Choices& c) {
             for (std::size_t i = 0; i < c.knobs.size(); ++i) m.scene().set_knob(i, c.knobs[i]);
         },
         true},
    Kind{[](const Choices& a, const Choices& b) { return a.materials == b.materials; },
         [](const Choices&) { return std::string("material"); },
         [](ViewerModel& m, const Choices& c) {
             for (std::uint32_t i = 0; i < c.materials.size(); ++i) m.scene().set_material(i, c.materials[i]);
         },
         true},
    Kind{[](const Choices& a, const Choices& b) {
             return camera_values(a.settings.camera) == camera_values(b.settings.camera);
         },
         [](const Choices&) { return std::string("camera"); },
         [](ViewerModel& m, const Choices& c) { m.camera().set(c.settings.camera); }, true}};

/// The first kind that differs.
std::optional<std::size_t> change_between(const Choices& a, const Choices& b) {
    const auto kind = std::ranges::find_if(kKinds, [&](const Kind& k) { return !k.is_same(a, b); });
    if (kind == kKinds.end()) return std::nullopt;
    return static_cast<std::size_t>(kind - kKinds.begin());
}

Choices choices_of(const ViewerModel& model) {
    Choices choices{model.render().settings(), model.display().settings(), model.scene().materials().now(), {}};
    for (const KnobDescription& knob : model.scene().knobs()) choices.knobs.push_back(knob.value);
    return choices;
}

/// The window itself changes exposure or camera, again and again.
bool is_automatic(const ViewerModel& model) {
    return model.exposure().is_on() || model.flight().is_flying() || model.sequence().progress();
}

}  // namespace

void History::update(const ViewerModel& model, double seconds, bool is_dragging) {
    if (!is_dragging) is_same_drag_ = false;
    const Choices now = choices_of(model);
    const bool is_other_scene = scene_ != model.scene().name() || states_.empty() ||
                                states_[now_].choices.materials.size() != now.materials.size();
    if (is_other_scene) {
        scene_ = model.scene().name();
        states_.assign(1, {now});
        now_ = 0;
        return;
    }
    const auto kind = change_between(states_[now_].choices, now);
    if (!kind) return;
    if (is_automatic(model)) {
        states_[now_].choices = now;
        return;
    }
    const bool is_soon = seconds - changed_at_ < kMergeSeconds;
    const bool merges = now_ > 0 && states_[now_].kind == *kind && kKinds[*kind].merges && (is_same_drag_ || is_soon);
    changed_at_ = seconds;
    is_same_drag_ = is_dragging;
    states_.resize(merges ? now_ : now_ + 1);
    if (merges && !change_between(states_.back().choices, now)) {  // back where it began
        now_ = states_.size() - 1;
        return;
    }
    states_.push_back({now, kKinds[*kind].name(now), *kind});
    if (states_.size() > kMost) states_.erase(states_.begin());
    now_ = states_.size() - 1;
}

void History::undo(ViewerModel& model) {
    if (now_ == 0) return model.messages().say(MessageLevel::Info, "nothing to undo");
    const std::string change = states_[now_].change;
    go(model, now_ - 1);
    model.messages().say(MessageLevel::Info, "undone: " + change);
}

void History::redo(ViewerModel& model) {
    if (now_ + 1 >= states_.size()) return model.messages().say(MessageLevel::Info, "nothing to redo");
    go(model, now_ + 1);
    model.messages().say(MessageLevel::Info, "done again: " + states_[now_].change);
}

void History::go(ViewerModel& model, std::size_t state) {
    now_ = state;
    const Choices before = choices_of(model);
    for (const Kind& kind : kKinds)
        if (!kind.is_same(before, states_[now_].choices)) kind.apply(model, states_[now_].choices);
    states_[now_].choices = choices_of(model);  // what could not be set again is no change of the user
    is_same_drag_ = false;
    changed_at_ = -kMergeSeconds;
}

}  // namespace pl::ui
