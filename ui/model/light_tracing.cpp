#include "ui/model/light_tracing.h"

#include "core/base/timer.h"
#include "core/session/path_settings.h"

namespace pl {
namespace {

constexpr double kSliceSeconds = 0.25;

bool is_lambert_at(const HostScene& scene, const SurfacePoint& site) {
    return scene.lobes.empty() || scene.lobes[site.material].kind == SurfaceKind::Diffuse;
}

/// Lambert reflectors look the same from everywhere: a moved camera leaves their light as it is.
LightReceiver receiver_of(const PublishedFrame& frame, const VolumeInspection& volume) {
    LightReceiver receiver = LightReceiver::of(volume, frame.snapshot.camera.eye);
    if (is_lambert_at(*frame.scene, volume.site)) receiver.wo = volume.normal;
    return receiver;
}

bool has_room(const LightGatherer& gatherer) {
    return gatherer.light().paths_per_cell() * gatherer.light().cells() < LightTracing::kMostPaths;
}

}  // namespace

LightTracing::Subject LightTracing::subject_of(const PublishedFrame& frame, const LightReceiver& receiver) {
    return {.scene = frame.scene,
            .volume = receiver.volume,
            .side = receiver.side,
            .position = receiver.site.position,
            .wo = receiver.wo,
            .seed = frame.settings.seed,
            .max_depth = static_cast<std::uint32_t>(frame.settings.max_depth)};
}

void LightTracing::start_over(const PublishedFrame& frame, const LightReceiver& receiver) {
    job_.reset();
    subject_ = subject_of(frame, receiver);
    report_.reset();
    compared_.reset();
    seconds_ = 0.0;
    failure_.clear();
    gatherer_ =
        std::make_shared<LightGatherer>(frame.scene, receiver, path_settings(frame.settings, baseline_method()));
}

void LightTracing::take_slice() {
    if (!job_) return;
    auto result = job_->take_result();
    if (!result) return;
    job_.reset();
    seconds_ += result->value.seconds;
    failure_ = result->failure;
    if (result->value.report) report_ = result->value.report;
}

bool LightTracing::is_complete() const { return gatherer_ == nullptr || !has_room(*gatherer_); }

void LightTracing::begin_slice(const PublishedFrame& frame) {
    compared_ = frame.volume;
    const TargetLight target = target_light(frame.settings, field_owner(frame.snapshot.slot.method));
    job_ = std::make_unique<BackgroundJob<Slice>>(
        [=, gatherer = gatherer_, volume = frame.volume](const JobMonitor& monitor) {
            const Stopwatch watch;
            while (has_room(*gatherer) && watch.seconds() < kSliceSeconds && gatherer->advance(monitor.stop)) {
            }
            Slice slice;
            if (gatherer->light().has_all_groups())
                slice.report = std::make_shared<const LightReport>(report_light(gatherer->light(), *volume, target));
            slice.seconds = watch.seconds();
            return slice;
        });
}

void LightTracing::update(const std::shared_ptr<const PublishedFrame>& frame, const VolumeInspection* volume) {
    take_slice();
    const bool is_shown = std::exchange(is_shown_, false);
    if (volume == nullptr || frame == nullptr) {
        job_.reset();
        gatherer_.reset();
        report_.reset();
        subject_ = {};
        return;
    }
    if (!is_shown) {
        if (job_) job_->stop();
        return;
    }
    const LightReceiver receiver = receiver_of(*frame, *volume);
    if (subject_of(*frame, receiver) != subject_) start_over(*frame, receiver);
    const bool has_news = compared_ != frame->volume;
    if (!job_ && failure_.empty() && (!is_complete() || has_news)) begin_slice(*frame);
}

}  // namespace pl
