#include "ui/model/light_tracing.h"

#include "core/base/timer.h"
#include "core/session/path_settings.h"

namespace pl::ui {
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

std::vector<FigurePoint> past_figures(const IncidentLight& light, const FieldHistory& history, std::int32_t volume,
                                      TargetLight target) {
    std::vector<FigurePoint> points;
    for (const auto& frame : history.frames)
        if (static_cast<std::size_t>(volume) < frame->volumes() &&
            static_cast<std::size_t>(frame->bins()) == light.cells())
            points.push_back({frame->passes(), LightComparison(light, frame->inspect(volume), target).figures()});
    return points;
}

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
    curve_.clear();
    past_.reset();
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
    if (!result->value.report) return;
    report_ = result->value.report;
    extend_curve(result->value);
}

bool LightTracing::is_complete() const { return gatherer_ == nullptr || !has_room(*gatherer_); }

void LightTracing::extend_curve(const Slice& slice) {
    if (!slice.past.empty()) curve_ = slice.past;
    const std::size_t size = curve_.size();
    // The newest point is replaced until it is a tenth beyond the one before it.
    if (size >= 2 && size > slice.past.size() && 10 * curve_[size - 1].passes < 11 * curve_[size - 2].passes)
        curve_.pop_back();
    if (curve_.empty() || curve_.back().passes < slice.passes)
        curve_.push_back({slice.passes, slice.report->figures});
}

void LightTracing::begin_slice(const PublishedFrame& frame, const std::shared_ptr<const FieldHistory>& history) {
    compared_ = frame.volume;
    past_ = history;
    const TargetLight target = target_light(frame.settings, field_owner(frame.snapshot.slot.method));
    job_ = std::make_unique<BackgroundJob<Slice>>(
        [=, gatherer = gatherer_, volume = frame.volume,
         passes = frame.snapshot.field ? frame.snapshot.field->passes : 0](const JobMonitor& monitor) {
            const Stopwatch watch;
            while (has_room(*gatherer) && watch.seconds() < kSliceSeconds && gatherer->advance(monitor.stop)) {
            }
            Slice slice;
            if (gatherer->light().has_all_groups())
                slice.report = std::make_shared<const LightReport>(report_light(gatherer->light(), *volume, target));
            if (slice.report && history)
                slice.past = past_figures(gatherer->light(), *history, volume->volume, target);
            slice.passes = passes;
            slice.seconds = watch.seconds();
            return slice;
        });
}

void LightTracing::update(const std::shared_ptr<const PublishedFrame>& frame, const VolumeInspection* volume,
                          const std::shared_ptr<const FieldHistory>& history) {
    take_slice();
    const bool is_shown = std::exchange(is_shown_, false);
    if (volume == nullptr || frame == nullptr) {
        job_.reset();
        gatherer_.reset();
        report_.reset();
        curve_.clear();
        past_.reset();
        subject_ = {};
        return;
    }
    if (!is_shown) {
        if (job_) job_->stop();
        return;
    }
    const LightReceiver receiver = receiver_of(*frame, *volume);
    if (subject_of(*frame, receiver) != subject_) start_over(*frame, receiver);
    const bool has_news = compared_ != frame->volume || past_ != history;
    if (!job_ && failure_.empty() && (!is_complete() || has_news)) begin_slice(*frame, history);
}

}  // namespace pl::ui
