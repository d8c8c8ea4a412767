#include "ui/model/viewer_model.h"
#include "core/scene/instances.h"
#include "ui/draw/value_text.h"

#include <fmt/format.h>

namespace pl::ui {
namespace {

WorkerSetup worker_setup(const ViewerOptions& options, std::shared_ptr<const SceneDescription> scene,
                         const RenderSettings& settings, double load_seconds) {
    return {.make_backend = options.make_backend,
            .backends = options.backends,
            .first_backend = options.first_backend,
            .scene = std::move(scene),
            .settings = settings,
            .limits = options.limits,
            .load_seconds = load_seconds,
            .display = options.display,
            .learned = options.field};
}

}  // namespace

ViewerModel::ViewerModel(const ViewerOptions& options, std::shared_ptr<const SceneDescription> scene,
                         const RenderSettings& settings, double load_seconds)
    : jobs_(messages_), link_(worker_setup(options, scene, settings, load_seconds)),
      display_(options.display, link_.worker()),
      camera_(options.settings.camera, CameraControls(settings.camera, bounds_of(*scene).diagonal()), link_.worker()),
      selection_(link_, display_, messages_), render_({options, messages_, jobs_, link_}, camera_, settings),
      scene_({options, messages_, jobs_, link_}, camera_, selection_, scene),
      references_({options, messages_, jobs_, link_}, render_, scene_),
      comparison_(link_, messages_, render_, references_), diagnostics_(link_, messages_, render_),
      self_test_({options, messages_, jobs_, link_}),
      files_({options, messages_, jobs_, link_}, scene_, render_, display_, comparison_),
      open_dialog_({options, messages_, jobs_, link_}, files_), paths_(link_, messages_), time_(link_),
      flowers_(link_, time_), past_film_({options, messages_, jobs_, link_}, scene_, time_, flowers_),
      gain_marks_(link_), exposure_(link_, display_), bookmarks_({options, messages_, jobs_, link_}, scene_, camera_),
      flight_(bookmarks_, camera_, messages_),
      sequence_({options, messages_, jobs_, link_}, bookmarks_, camera_, render_, files_.pictures()) {
    link_.worker().set_denoised_wanted(display_.denoises());
    for (const std::string& warning : scene->warnings) messages_.say(MessageLevel::Warning, warning);
    messages_.note(MessageLevel::Info,
                   fmt::format("opened {}: {} triangles", scene_.name(), shown_triangles(*scene)));
}

ViewerModel::~ViewerModel() {
    files_.pictures().finish();
    jobs_.finish();  // its jobs use the objects above it
}

void ViewerModel::update(double seconds) {
    messages_.set_time(seconds);
    camera_.update(seconds);
    link_.update();
    scene_.update();
    files_.pictures().update();
    link_.worker().set_values_wanted(window_.values_shown || files_.pictures().is_waiting() ||
                                     exposure_.needs_values());
    link_.worker().set_denoised_wanted(display_.denoises() && comparison_.state().mode == CompareMode::Off);
    exposure_.update();
    bookmarks_.update();
    flight_.update(seconds);
    sequence_.update();
    references_.update();
    comparison_.update();
    for (const WorkerMessage& message : link_.worker().take_messages())
        messages_.say(message.is_error ? MessageLevel::Error : MessageLevel::Info, message.text);
    if (link_.frame()) effects_.update(*link_.frame());
    outside_.update(link_.frame());
    selection_.update();
    files_.fields().update();
    diagnostics_.update();
    paths_.update();
    time_.update(seconds);
    flowers_.update();
    past_film_.update();
    gain_marks_.update(seconds);
    self_test_.update();
    jobs_.update();
    tour_.update(*this, seconds);
    history_.update(*this, seconds, window_.is_dragging);
    messages_.drop_expired();
}

Vec3f ViewerModel::orbit_center() const {
    const auto& picked = selection_.picked();
    return picked ? picked->position : camera_.camera().target;
}

bool ViewerModel::busy() const {
    return jobs_.pending() > 0 || files_.pictures().is_waiting() || references_.is_making() ||
           diagnostics_.is_searching() || self_test_.run().is_running() || sequence_.progress().has_value() ||
           past_film_.written();
}

bool ViewerModel::shows_denoised() const {
    return frame() != nullptr && frame()->denoised.width > 0 && display_.denoises() &&
           comparison_.state().mode == CompareMode::Off && window_.zoom.is_whole() && !window_.requests.window_shot &&
           !window_.requests.view_shot;
}

std::string ViewerModel::title() const {
    const std::string back_end = frame() != nullptr ? back_end_label(status().backend) : "starting";
    std::string text =
        fmt::format("{} spp - {}, {} - {} - {}", status().passes, method_text(render_.settings(), render_.method()),
                    light_samples_text(render_.settings().next_event), back_end, scene_.name());
    if (status().state == WorkerState::Done) text = "done: " + text;
    if (status().state == WorkerState::Paused) text = "paused: " + text;
    return text + " - pathlight";
}

void ViewerModel::cancel() {
    if (window_.keyed_panel)
        window_.keyed_panel.reset();
    else if (window_.help)
        window_.help = false;
    else if (window_.about)
        window_.about = false;
    else if (open_dialog_.is_shown())
        open_dialog_.is_shown() = false;
    else if (self_test_.is_shown() && self_test_.run().is_running())
        self_test_.stop();
    else if (self_test_.is_shown())
        self_test_.is_shown() = false;
    else if (sequence_.progress())
        sequence_.stop();
    else if (past_film_.written())
        past_film_.stop();
    else if (flight_.is_flying())
        flight_.stop();
    else if (status().state == WorkerState::Precomputing)
        render_.cancel_precomputation();
    else if (references_.is_making())
        references_.stop();
    else if (diagnostics_.is_searching() || diagnostics_.map())
        diagnostics_.toggle();
    else if (paths_.is_shown())
        paths_.set_shown(false);
    else if (gain_marks_.is_shown())
        gain_marks_.set_shown(false);
    else if (selection_.volume() == kNoVolume && tour_.phase() != GuidedTour::Phase::Off)
        tour_.leave();
    else if (selection_.volume() != kNoVolume)
        selection_.deselect();
    else if (comparison_.in_turns() || comparison_.state().mode != CompareMode::Off)
        comparison_.end();
    else if (!window_.panels.shown)
        window_.panels.shown = true;
    else
        selection_.deselect();
}

}  // namespace pl::ui
