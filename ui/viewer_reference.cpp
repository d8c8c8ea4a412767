// The part of ViewerModel that finds references of the picture in the window, and makes them.
#include <fmt/format.h>

#include "ui/stored_reference.h"
#include "ui/viewer_model.h"

namespace pl {

const ReferencePicture* ViewerModel::reference() const {
    return reference_ && reference_->picture == status_.picture ? &*reference_ : nullptr;
}

std::optional<ReferenceJob::Progress> ViewerModel::reference_progress() const {
    return reference_job_ ? std::optional(reference_job_->progress()) : std::nullopt;
}

/// Once for every picture that the window comes to show.
void ViewerModel::look_for_reference() {
    if (status_.picture == 0 || status_.picture == looked_for_) return;
    looked_for_ = status_.picture;
    if (reference() != nullptr) return;
    push_job([this, scene = open_scene(), settings = asked_settings()]() -> JobThread::Report {
        const auto found = find_stored_reference(options_.reference_dir, *scene.description, settings);
        if (!found) return {};
        return [this, found] { adopt_reference(found); };
    });
}

/// One of another picture than the one in the window is kept until that is shown again, and never scored with.
void ViewerModel::adopt_reference(const std::shared_ptr<const StoredReference>& found) {
    const LiveReference& halves = found->halves;
    const std::vector<Vec3f> mean = weighted_mean(halves.first, found->spp[0], halves.second, found->spp[1]);
    reference_ = ReferencePicture{
        .picture = halves.picture,
        .pixels = std::make_shared<const HalfPicture>(half_picture(halves.width, halves.height, mean)),
        .label = fmt::format("reference  {} + {} spp", found->spp[0], found->spp[1]),
        .noise_relmse = found->noise_relmse};
    worker_.set_reference({found, &found->halves});
    say(LogLevel::Info, fmt::format("{}, its noise as relMSE is {:.2g}", reference_->label, found->noise_relmse));
}

void ViewerModel::make_reference() {
    if (reference_job_) return;
    if (status_.picture == 0) {
        say(LogLevel::Info, "a reference needs a picture at rest: let it render first");
        return;
    }
    set_turns(false);
    reference_job_ = std::make_unique<ReferenceJob>(
        [this, scene = open_scene(), settings = asked_settings()](const JobMonitor& monitor) {
            return make_stored_reference(options_.reference_dir, scene, settings, options_.make_backend, monitor);
        });
    hold_rendering();
    say(LogLevel::Info, "making the reference: Esc ends it, and keeps what is there");
}

void ViewerModel::stop_reference() {
    if (reference_job_) reference_job_->stop();
}

void ViewerModel::take_reference() {
    if (!reference_job_) return;
    const auto result = reference_job_->take_result();
    if (!result) return;
    reference_job_.reset();
    hold_rendering();
    if (!result->failure.empty())
        say(LogLevel::Error, "the reference could not be made: " + result->failure);
    else if (result->value)
        adopt_reference(result->value);
    else
        say(LogLevel::Info, "the reference was ended before both halves had samples");
}

/// Work in the background would slow down what is measured: rendering rests meanwhile, and its clocks too.
void ViewerModel::hold_rendering() {
    worker_.set_paused(paused_ || reference_job_ != nullptr || diagnostics_.is_searching() ||
                       self_test_.is_running());
}

}  // namespace pl
