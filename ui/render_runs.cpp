// The part of RenderWorker that records runs: error and noise against time of everything that is rendered.
#include <fmt/format.h>

#include "core/measure/picture_identity.h"
#include "ui/render_worker.h"

namespace pl {
namespace {

/// What a person has changed that tells one run of a method from another on the same picture.
std::string details_of(const Session& session) {
    const RenderSettings& settings = session.settings();
    const RenderSettings standard;
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    if (settings.roulette == RouletteRule::Albedo) add("albedo roulette");
    if (settings.roulette == RouletteRule::Field) add("field roulette");
    const FeatureSet needed = session.needed_features();
    if (!needed.covers(session.film_origin().forced)) add("effects forced");
    if (!info_of(settings.method).uses_field) return text;
    FieldSettings field = settings.field;
    field.lookup = standard.field.lookup;  // the same bits
    if (field.volumes != standard.field.volumes) add(fmt::format("{} volumes", field.volumes));
    if (field.bins != standard.field.bins) add(fmt::format("{} bins", field.bins));
    if (field.refine_share != standard.field.refine_share)
        add(field.refine_share == 0.0f ? "not refined" : fmt::format("refined by {:g}", field.refine_share));
    field.refine_share = standard.field.refine_share;
    field.volumes = standard.field.volumes;
    field.bins = standard.field.bins;
    if (!(field == standard.field) || !(settings.mixture == standard.mixture)) add("other learning");
    return text;
}

}  // namespace

LiveRuns RenderWorker::make_runs() { return LiveRuns(kRunPictureBytes, details_of); }

/// After each piece of work on a whole picture: what is coarse is not measured.
void RenderWorker::observe_run() {
    if (coarse() || divider_ != 1) return;
    note_picture();
    if (!runs_.observe(*session_)) return;
    const std::lock_guard lock(mutex_);
    run_set_ = runs_.current();
}

/// What the session shows now. Hashing a scene takes its time: only when all pictures were emptied.
void RenderWorker::note_picture() {
    const FilmOrigin origin = session_->film_origin();
    if (origin.number == 0 || (picture_ != 0 && origin.generation == picture_generation_)) return;
    picture_generation_ = origin.generation;
    picture_ = picture_key(session_->scene(), session_->settings());
}

/// The reference as the window last gave it.
void RenderWorker::adopt_reference() {
    if (now_.reference == reference_) return;
    reference_ = now_.reference;
    attempt([this] { runs_.set_reference(reference_); });
    const std::lock_guard lock(mutex_);
    run_set_ = runs_.current();
}

}  // namespace pl
