#include "ui/model/render_controls.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/fields/field_choices.h"
#include "core/fields/field_kernels.h"
#include "ui/draw/value_text.h"

namespace pl::ui {

RenderControls::RenderControls(const ModelServices& services, CameraMotion& camera, const RenderSettings& settings)
    : messages_(services.messages), link_(services.link), worker_(link_.worker()), camera_(camera),
      settings_(settings), limits_(services.options.limits), previous_method_(baseline_method()) {}

RenderSettings RenderControls::settings() const {
    RenderSettings settings = settings_;
    settings.camera = camera_.camera();
    // The session counts the passes after which a field was frozen.
    if (link_.frame()) settings.learn_passes = link_.frame()->settings.learn_passes;
    return settings;
}

void RenderControls::set_method(MethodId method) {
    link_.end_turns(settings_.method);
    if (method == settings_.method) return;
    previous_method_ = settings_.method;
    settings_.method = method;
    worker_.submit(method);
}

void RenderControls::set_view(View view) {
    if (view == settings_.view) return;
    settings_.view = view;
    worker_.submit(view);
}

void RenderControls::step_view(int steps) {
    const int count = static_cast<int>(all_views().size());
    const int index = (static_cast<int>(settings_.view) + steps % count + count) % count;
    set_view(all_views()[static_cast<std::size_t>(index)].id);
}

void RenderControls::set_next_event(bool on) {
    if (on == settings_.next_event) return;
    settings_.next_event = on;
    submit_estimator();
    messages_.note(MessageLevel::Info, fmt::format("{}: pictures and fields start over", light_samples_text(on)));
}

void RenderControls::set_max_depth(int depth) {
    if (depth == settings_.max_depth || depth < 1) return;
    settings_.max_depth = depth;
    submit_estimator();
}

void RenderControls::set_roulette(RouletteRule rule) {
    if (rule == settings_.roulette) return;
    settings_.roulette = rule;
    submit_estimator();
}

void RenderControls::set_guiding(GuidingRule rule) {
    if (rule == settings_.guiding) return;
    settings_.guiding = rule;
    submit_estimator();
}

void RenderControls::submit_estimator() {
    worker_.submit(EditEstimator{settings_.max_depth, settings_.next_event, settings_.roulette, settings_.guiding});
}

void RenderControls::set_seed(std::uint64_t seed) {
    if (seed == settings_.seed) return;
    settings_.seed = seed;
    worker_.submit(EditSeed{seed});
}

void RenderControls::set_mixture(MixtureSettings mixture) {
    mixture.bsdf_fraction = std::clamp(mixture.bsdf_fraction, kMinBsdfFraction, 1.0f);
    if (mixture == settings_.mixture) return;
    settings_.mixture = mixture;
    camera_.touch();
    worker_.submit(EditMixture{mixture});
}

void RenderControls::set_field(const FieldSettings& field) {
    if (field == settings_.field || !is_served(field, wanted_backend())) return;
    settings_.field = field;
    worker_.submit(EditField{field});
}

void RenderControls::set_size(int width, int height) {
    if (width < 1 || height < 1 || (width == settings_.width && height == settings_.height)) return;
    settings_.width = width;
    settings_.height = height;
    worker_.submit(EditSize{width, height});
}

void RenderControls::adopt_field(const std::shared_ptr<LearnedField>& field) {
    link_.end_turns(settings_.method);
    if (field->method != settings_.method) previous_method_ = settings_.method;
    settings_.method = field->method;
    settings_.field = field->settings;
    worker_.submit(EditLearned{field});
}

// --- the progress of the rendering -----------------------------------------------------------------------------

void RenderControls::set_limits(const SampleLimits& limits) {
    if (limits == limits_) return;
    limits_ = limits;
    worker_.set_limits(limits);
}

void RenderControls::single_pass() {
    if (!paused()) {
        messages_.say(MessageLevel::Info, "single passes need a paused picture: press Space first");
        return;
    }
    worker_.step();
}

void RenderControls::restart() { worker_.submit(EditRestart{}); }

void RenderControls::forget() {
    worker_.submit(EditForget{});
    messages_.say(MessageLevel::Info, "forgot the learned field");
}

void RenderControls::control_learning(LearningControl control) {
    if (!info_of(settings_.method).learns) {
        messages_.say(MessageLevel::Info,
                      fmt::format("{} does not learn while it renders", info_of(settings_.method).name));
        return;
    }
    worker_.submit(EditLearning{settings_.method, control});
}

void RenderControls::forget_volume(std::int32_t volume) {
    worker_.submit(EditForgetVolume{settings_.method, volume});
    messages_.say(MessageLevel::Info, fmt::format("volume {} has forgotten what it learned", volume));
}

void RenderControls::cancel_precomputation() {
    const bool back = previous_method_ != settings_.method;
    set_method(back ? previous_method_ : baseline_method());
    messages_.say(MessageLevel::Info,
                  fmt::format("precomputation interrupted, back to {}", info_of(settings_.method).name));
}

// --- back ends -------------------------------------------------------------------------------------------------

/// Whether a back end serves the field; says so if it does not.
bool RenderControls::is_served(const FieldSettings& field, const std::string& backend) {
    if (!has_target(field.representation, field.learning.target)) {
        messages_.say(MessageLevel::Warning,
                      fmt::format("{} trains tables alone: this field learns by {}", label_of(field.learning.target),
                                  label_of(LearningTarget::ExpectedSarsa)));
        return false;
    }
    if (backend == "cpu" || is_for_devices(field.representation)) return true;
    messages_.say(MessageLevel::Warning, fmt::format("{} has no kernels for the field {}: it needs the CPU",
                                                     back_end_label(backend), label_of(field.representation)));
    return false;
}

void RenderControls::set_backend(const std::string& name) {
    const auto& choices = *link_.status().backends;
    const auto choice = std::ranges::find(choices, name, &BackendChoice::name);
    if (choice == choices.end() || name == wanted_backend()) return;
    if (!choice->unavailable.empty()) {
        messages_.say(MessageLevel::Warning,
                      fmt::format("{} is unavailable: {}", back_end_label(name), choice->unavailable));
        return;
    }
    const bool has_second = link_.turns() && link_.turns()->second;
    if (!is_served(settings_.field, name) || (has_second && !is_served(link_.turns()->second->field, name))) return;
    backend_generation_ = worker_.switch_backend(name);
}

void RenderControls::next_backend() {
    const auto& choices = *link_.status().backends;
    if (choices.size() < 2) {
        messages_.say(MessageLevel::Info, "there is no other back end");
        return;
    }
    const auto wanted = std::ranges::find(choices, wanted_backend(), &BackendChoice::name);
    const auto index = static_cast<std::size_t>(wanted - choices.begin());
    set_backend(choices[(index + 1) % choices.size()].name);
}

}  // namespace pl::ui
