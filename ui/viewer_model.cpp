#include "ui/viewer_model.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"

namespace pl {
namespace {

constexpr double kRestSeconds = 0.1;  ///< without input until the picture is whole again
constexpr double kToastSeconds = 4.0;
constexpr double kErrorToastSeconds = 10.0;
constexpr std::size_t kMaxToasts = 4;
constexpr std::size_t kMaxLogLines = 1000;
constexpr double kThroughputSeconds = 0.5;
constexpr float kMaxExposureEv = 16.0f;

}  // namespace

ViewerModel::ViewerModel(const ViewerOptions& options, std::shared_ptr<const SceneDescription> scene,
                         const RenderSettings& settings, double load_seconds)
    : options_(options), scene_name_(options.scene_name), settings_(settings), display_(options.display),
      limits_(options.limits), controls_(settings.camera, bounds_of(*scene).diagonal()), materials_(scene),
      worker_({options.make_backend, options.backends, options.first_backend, scene, settings, options.limits,
               load_seconds, options.display}) {
    if (options.field) worker_.submit(EditLearned{options.field});
    status_ = worker_.status();
    for (const std::string& warning : scene->warnings) say(LogLevel::Warning, warning);
    note(LogLevel::Info, fmt::format("opened {}: {} triangles", scene_name_, scene->triangles.size()));
}

void ViewerModel::update(double seconds) {
    now_ = seconds;
    if (const std::exception_ptr failure = worker_.failure()) std::rethrow_exception(failure);
    if (moving_ && now_ >= moving_until_) {
        moving_ = false;
        worker_.set_moving(false);
    }
    take_frame();
    status_ = worker_.status();
    take_runs();
    for (const WorkerMessage& message : worker_.take_messages())
        say(message.is_error ? LogLevel::Error : LogLevel::Info, message.text);
    take_effects();
    take_pick();
    take_learned();
    take_diagnostics();
    take_self_test();
    for (const JobThread::Report& report : jobs_.take_reports())
        if (report) report();
    std::erase_if(toasts_, [&](const Toast& toast) { return toast.until <= now_; });
}

void ViewerModel::take_frame() {
    if (auto latest = worker_.latest(); latest != latest_) {
        latest_ = std::move(latest);
        const MethodId method = latest_->snapshot.slot.method;
        if (turns_ && frame_ && method == (*turns_)[1]) {
            turn_frame_ = latest_;
        } else {
            frame_ = latest_;
            measure_throughput();
        }
    }
    if (!unsaved_.empty()) write_unsaved();
    worker_.set_values_wanted(window_.values_shown || !unsaved_.empty());
}

void ViewerModel::measure_throughput() {
    const Snapshot& snapshot = frame_->snapshot;
    const double seconds = snapshot.clocks.render;
    const bool other_film = snapshot.slot != measured_slot_ || frame_->backend.name != measured_backend_ ||
                            snapshot.counters.paths < measured_paths_;
    if (other_film) {
        measured_slot_ = snapshot.slot;
        measured_backend_ = frame_->backend.name;
        measured_paths_ = 0;
        measured_seconds_ = 0.0;
    }
    const double elapsed = seconds - measured_seconds_;
    if (elapsed <= 0.0 || (elapsed < kThroughputSeconds && measured_paths_ > 0)) return;
    mpaths_per_second_ = 1.0e-6 * static_cast<double>(snapshot.counters.paths - measured_paths_) / elapsed;
    measured_paths_ = snapshot.counters.paths;
    measured_seconds_ = seconds;
}

const VolumeInspection* ViewerModel::inspection() const {
    if (!frame_ || !frame_->volume || frame_->volume->volume != selected_volume_ || frame_->volume->side == 0)
        return nullptr;
    return frame_->volume.get();
}

std::string ViewerModel::title() const {
    const std::string back_end = frame_ ? back_end_label(status_.backend) : "starting";
    std::string text =
        fmt::format("{} spp - {} - {} - {}", status_.passes, info_of(settings_.method).label, back_end, scene_name_);
    if (status_.state == WorkerState::Done) text = "done: " + text;
    if (status_.state == WorkerState::Paused) text = "paused: " + text;
    return text;
}

RenderSettings ViewerModel::asked_settings() const {
    RenderSettings settings = settings_;
    settings.camera = controls_.camera();
    return settings;
}

std::string ViewerModel::command_line() const {
    return options_.command_line ? options_.command_line(picture()) : "";
}

// --- edits -----------------------------------------------------------------------------------------------------

void ViewerModel::set_method(MethodId method) {
    set_turns(false);
    if (method == settings_.method) return;
    previous_method_ = settings_.method;
    settings_.method = method;
    worker_.submit(EditMethod{method});
}

void ViewerModel::set_view(View view) {
    if (view == settings_.view) return;
    settings_.view = view;
    worker_.submit(EditView{view});
}

void ViewerModel::step_view(int steps) {
    const int count = static_cast<int>(all_views().size());
    const int index = (static_cast<int>(settings_.view) + steps % count + count) % count;
    set_view(all_views()[static_cast<std::size_t>(index)].id);
}

void ViewerModel::set_backend(const std::string& name) {
    const auto& choices = *status_.backends;
    const auto choice = std::ranges::find(choices, name, &BackendChoice::name);
    if (choice == choices.end() || name == wanted_backend()) return;
    if (!choice->unavailable.empty()) {
        say(LogLevel::Warning, fmt::format("{} is unavailable: {}", back_end_label(name), choice->unavailable));
        return;
    }
    backend_generation_ = worker_.switch_backend(name);
}

void ViewerModel::next_backend() {
    const auto& choices = *status_.backends;
    if (choices.size() < 2) {
        say(LogLevel::Info, "there is no other back end");
        return;
    }
    const auto wanted = std::ranges::find(choices, wanted_backend(), &BackendChoice::name);
    const auto index = static_cast<std::size_t>(wanted - choices.begin());
    set_backend(choices[(index + 1) % choices.size()].name);
}

void ViewerModel::set_next_event(bool on) {
    if (on == settings_.next_event) return;
    settings_.next_event = on;
    submit_estimator();
    note(LogLevel::Info, on ? "next-event estimation on: pictures and tables start over"
                            : "next-event estimation off: pictures and tables start over");
}

void ViewerModel::set_max_depth(int depth) {
    if (depth == settings_.max_depth || depth < 1) return;
    settings_.max_depth = depth;
    submit_estimator();
}

void ViewerModel::set_roulette(RouletteRule rule) {
    if (rule == settings_.roulette) return;
    settings_.roulette = rule;
    submit_estimator();
}

void ViewerModel::submit_estimator() {
    worker_.submit(EditEstimator{settings_.max_depth, settings_.next_event, settings_.roulette});
}

void ViewerModel::set_seed(std::uint64_t seed) {
    if (seed == settings_.seed) return;
    settings_.seed = seed;
    worker_.submit(EditSeed{seed});
}

void ViewerModel::set_mixture(MixtureSettings mixture) {
    mixture.bsdf_fraction = std::clamp(mixture.bsdf_fraction, kMinBsdfFraction, 1.0f);
    if (mixture == settings_.mixture) return;
    settings_.mixture = mixture;
    touch_motion();
    worker_.submit(EditMixture{mixture});
}

void ViewerModel::set_field(const FieldSettings& field) {
    if (field == settings_.field) return;
    settings_.field = field;
    deselect();
    worker_.submit(EditField{field});
}

void ViewerModel::set_size(int width, int height) {
    if (width < 1 || height < 1 || (width == settings_.width && height == settings_.height)) return;
    settings_.width = width;
    settings_.height = height;
    worker_.submit(EditSize{width, height});
}

void ViewerModel::set_limits(const SampleLimits& limits) {
    if (limits == limits_) return;
    limits_ = limits;
    worker_.set_limits(limits);
}

void ViewerModel::set_paused(bool paused) {
    paused_ = paused;
    hold_rendering();
}

void ViewerModel::single_pass() {
    if (!paused_) {
        say(LogLevel::Info, "single passes are for a paused picture: press Space first");
        return;
    }
    worker_.step();
}

void ViewerModel::restart() { worker_.submit(EditRestart{}); }

void ViewerModel::forget() {
    worker_.submit(EditForget{});
    say(LogLevel::Info, "forgot what was learned");
}

void ViewerModel::cancel() {
    if (window_.help)
        window_.help = false;
    else if (window_.self_test && self_test_.is_running())
        stop_self_test();
    else if (window_.self_test)
        window_.self_test = false;
    else if (status_.state == WorkerState::Precomputing)
        cancel_precomputation();
    else if (reference_job_)
        stop_reference();
    else if (diagnostics_.is_searching() || diagnostics())
        toggle_diagnostics();
    else if (selected_volume_ != kNoVolume || window_.compare.mode == CompareMode::Off)
        deselect();
    else
        set_compare_mode(CompareMode::Off);
}

void ViewerModel::cancel_precomputation() {
    const bool back = previous_method_ != settings_.method;
    set_method(back ? previous_method_ : MethodId::Default);
    say(LogLevel::Info, fmt::format("precomputation interrupted, back to {}", info_of(settings_.method).name));
}

// --- display ---------------------------------------------------------------------------------------------------

void ViewerModel::set_exposure(float ev) {
    display_.exposure_ev = std::clamp(ev, -kMaxExposureEv, kMaxExposureEv);
    worker_.set_display(display_);
}

void ViewerModel::set_curve(ToneCurve curve) {
    display_.curve = curve;
    worker_.set_display(display_);
}

void ViewerModel::set_cells(bool on) {
    window_.cells = on;
    worker_.set_cells_wanted(on || selected_volume_ != kNoVolume);
}

void ViewerModel::set_cells_opacity(float opacity) { window_.cells_opacity = std::clamp(opacity, 0.0f, 1.0f); }

void ViewerModel::set_low_resolution(bool allowed) {
    window_.low_resolution = allowed;
    worker_.set_low_resolution_allowed(allowed);
}

// --- camera ----------------------------------------------------------------------------------------------------

void ViewerModel::touch_motion() {
    moving_until_ = now_ + kRestSeconds;
    if (moving_) return;
    moving_ = true;
    worker_.set_moving(true);
}

void ViewerModel::submit_camera() {
    touch_motion();
    settings_.camera = controls_.camera();
    camera_generation_ = worker_.submit(EditCamera{settings_.camera});
}

void ViewerModel::fly(const MoveKeys& keys, double seconds) {
    if (controls_.move(keys, seconds)) submit_camera();
}

void ViewerModel::look(Vec2f pixels) {
    if (pixels.x == 0.0f && pixels.y == 0.0f) return;
    controls_.look(pixels);
    submit_camera();
}

void ViewerModel::change_speed(float notches) {
    constexpr double kShownSeconds = 1.5;
    controls_.change_speed(notches);
    window_.speed_shown_until = now_ + kShownSeconds;
}

void ViewerModel::camera_home() {
    controls_.go_home();
    submit_camera();
}

void ViewerModel::set_camera(const CameraDescription& camera) {
    controls_.set_camera(camera);
    submit_camera();
}

void ViewerModel::focus_on_picked() {
    if (!picked_) return;
    CameraDescription camera = controls_.camera();
    const Vec3f forward = glm::normalize(camera.target - camera.eye);
    const float distance = glm::dot(picked_->position - camera.eye, forward);
    if (!(distance > 0.0f)) return;
    camera.focus_distance = distance;
    set_camera(camera);
}

// --- selection -------------------------------------------------------------------------------------------------

void ViewerModel::pick(Vec2f image_point) { worker_.request_pick(image_point); }

void ViewerModel::take_pick() {
    const std::optional<PickAnswer> answer = worker_.take_pick();
    if (!answer) return;
    if (!answer->point) {
        say(LogLevel::Info, "nothing to select there: the ray leaves the scene");
        return;
    }
    picked_ = answer->point;
    select_material(picked_->material);
    if (picked_->volume == kNoVolume) {
        say(LogLevel::Info, "no radiance volume serves this surface: it reflects nothing");
        return;
    }
    select(picked_->volume);
    window_.volume_tab_asked = true;
}

void ViewerModel::select(std::int32_t volume) {
    selected_volume_ = volume;
    window_.hovered_cell = -1;
    worker_.select_volume(volume);
    worker_.set_cells_wanted(window_.cells || volume != kNoVolume);
}

void ViewerModel::deselect() {
    picked_.reset();
    select(kNoVolume);
}

// --- messages --------------------------------------------------------------------------------------------------

void ViewerModel::note(LogLevel level, const std::string& text) {
    if (log_.size() >= kMaxLogLines) log_.erase(log_.begin());
    log_.push_back({now_, level, text});
}

void ViewerModel::say(LogLevel level, const std::string& text) {
    note(level, text);
    if (toasts_.size() >= kMaxToasts) toasts_.erase(toasts_.begin());
    toasts_.push_back({level, text, now_ + (level == LogLevel::Info ? kToastSeconds : kErrorToastSeconds)});
}

}  // namespace pl
