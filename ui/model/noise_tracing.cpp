#include "ui/model/noise_tracing.h"

#include "core/base/timer.h"

namespace pl::ui {
namespace {

constexpr double kNoiseSliceSeconds = 0.25;

}  // namespace

void NoiseTracing::drop() {
    job_.reset();
    passes_.reset();
    tracer_.reset();
    noise_.reset();
    seconds_ = 0.0;
    failure_.clear();
}

void NoiseTracing::take_slice() {
    if (!job_) return;
    auto result = job_->take_result();
    if (!result) return;
    job_.reset();
    failure_ = result->failure;
    tracer_ = result->value.tracer;
    seconds_ += result->value.seconds;
    if (result->value.noise) noise_ = result->value.noise;
}

void NoiseTracing::begin_slice() {
    job_ = std::make_unique<BackgroundJob<Slice>>(
        [tracer = tracer_, passes = passes_, pixel = pixel_](const JobMonitor& monitor) {
            const Stopwatch watch;
            Slice slice{.tracer = tracer ? tracer : std::make_shared<diagnose::PixelNoiseTracer>(*passes, pixel)};
            while (slice.tracer->paths() < kMostPaths && watch.seconds() < kNoiseSliceSeconds &&
                   slice.tracer->advance(monitor.stop)) {
            }
            if (slice.tracer->has_all_groups())
                slice.noise = std::make_shared<const diagnose::PixelNoise>(slice.tracer->noise());
            slice.seconds = watch.seconds();
            return slice;
        });
}

void NoiseTracing::update(const std::shared_ptr<const diagnose::PassPair>& passes, std::uint32_t pixel) {
    take_slice();
    const bool is_shown = std::exchange(is_shown_, false);
    if (passes != passes_ || pixel != pixel_) {
        drop();
        passes_ = passes;
        pixel_ = pixel;
    }
    if (!is_shown || !passes_) {
        if (job_) job_->stop();
        return;
    }
    if (!job_ && failure_.empty() && !is_complete()) begin_slice();
}

}  // namespace pl::ui
