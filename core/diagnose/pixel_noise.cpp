#include "core/diagnose/pixel_noise.h"

#include "core/base/thread_stopwatch.h"
#include "core/diagnose/record_path.h"
#include "core/diagnose/replay_path.h"

namespace pl::diagnose {

PixelNoiseTracer::PixelNoiseTracer(PassPair passes, std::uint32_t pixel) : passes_(std::move(passes)), pixel_(pixel) {
    passes_.plain.path.stream = Stream::Inspection;
    if (!passes_.guided) return;
    passes_.guided->path.stream = Stream::Inspection;
    passes_.guided->runs = {{}};
    field_ = field_of(*passes_.guided);
}

bool PixelNoiseTracer::advance(const StopFlag* stop) {
    if (stop != nullptr && *stop) return false;
    // Every second round begins with the other method, so that neither always finds the scene in the cache.
    const bool is_guided_first = steps_ / kJackknifeGroups % 2 == 1;
    if (passes_.guided && is_guided_first) trace(*passes_.guided, field_, guided_);
    trace(passes_.plain, AnyFieldView{}, plain_);
    if (passes_.guided && !is_guided_first) trace(*passes_.guided, field_, guided_);
    ++steps_;
    return true;
}

void PixelNoiseTracer::trace(const PassReplay& passes, const AnyFieldView& field, NoiseSums& sums) const {
    const std::size_t group = steps_ % kJackknifeGroups;
    const std::uint32_t first = passes.samples + paths();
    const ThreadStopwatch watch;
    for (std::uint32_t i = 0; i < kPathsPerStep; ++i)
        replay_path(passes, field, pixel_, passes.first_sample + first + i);
    sums.add_seconds(group, watch.seconds());
    for (std::uint32_t i = 0; i < kPathsPerStep; ++i)
        sums.add(group, contributions_of(record_path(passes, field, pixel_, first + i)));
}

PixelNoise PixelNoiseTracer::noise() const {
    PixelNoise noise{.pixel = pixel_, .plain = plain_.estimate(), .guided_method = passes_.guided_method};
    if (!passes_.guided) return noise;
    noise.guided = guided_.estimate();
    noise.gain = pixel_gain(plain_, guided_);
    return noise;
}

}  // namespace pl::diagnose
