#include "tests/bench/gain_run.h"

#include <algorithm>
#include <bit>
#include <ctime>

#include "core/session/session.h"
#include "cpu/cpu_backend.h"
#include "tests/bench/trimmed_errors.h"
#include "tests/bench/uniform_sampling.h"

namespace pl::benchmarks {
namespace {

bool is_checkpoint(const RunLength& length, std::uint32_t samples) {
    constexpr std::uint32_t kStep = 32;
    if (std::find(length.samples.begin(), length.samples.end(), samples) != length.samples.end()) return true;
    return samples <= kStep ? std::has_single_bit(samples) : samples % kStep == 0;
}

/// Processor time of chosen stretches of the program.
class ProcessorWatch {
public:
    template <class Work>
    auto time(Work&& work) {
        const std::clock_t start = std::clock();
        auto result = work();
        spent_ += std::clock() - start;
        return result;
    }
    double seconds() const { return static_cast<double>(spent_) / CLOCKS_PER_SEC; }

private:
    std::clock_t spent_ = 0;
};

}  // namespace

Errors errors_of(Pixels picture, const PictureHalves& reference) {
    const TrimmedErrors all = measure_trimmed(picture, reference, 0.0);
    const TrimmedErrors most = measure_trimmed(picture, reference, 0.001);
    const TrimmedErrors fewer = measure_trimmed(picture, reference, 0.01);
    return {all.mse, most.mse, fewer.mse, all.relmse, most.relmse, fewer.relmse};
}

GainRun measure_run(const RunSetting& setting, MethodId method, std::uint64_t seed) {
    RenderSettings settings = setting.settings;
    settings.method = method;
    settings.seed = seed;
    const FilmSlot slot = slot_of(settings);
    const RunLength& length = setting.length;
    GainRun run{.seed = seed, .points = {}};
    ProcessorWatch watch;
    const auto session = watch.time([&] {
        return std::make_unique<Session>(make_cpu_backend({.threads = setting.threads}), setting.scene, settings);
    });
    for (bool has_ended = false, was_late = false; !has_ended;) {
        if (watch.time([&] { return session->advance(slot); }) != Progress::Rendered) continue;
        const std::uint32_t samples = session->passes(slot);
        const bool is_late = watch.seconds() >= length.seconds;
        has_ended = is_late && samples >= length.samples.back();
        if (!has_ended && is_late == was_late && !is_checkpoint(length, samples)) continue;
        was_late = is_late;
        const Snapshot snapshot = session->snapshot(slot);
        run.points.push_back({samples, watch.seconds(), errors_of(snapshot.pixels, setting.reference)});
        run.dark_share = static_cast<double>(snapshot.counters.zero_contribution_paths) /
                         static_cast<double>(snapshot.counters.paths);
    }
    return run;
}

GainRun measure_uniform(const RunSetting& setting, std::uint64_t seed) {
    RenderSettings settings = setting.settings;
    settings.seed = seed;
    const std::uint32_t samples = setting.length.samples.back();
    const std::vector<Vec3f> picture = render_uniform(*setting.scene, settings, samples, setting.threads);
    return {.seed = seed, .points = {{samples, 0.0, errors_of(picture, setting.reference)}}};
}

}  // namespace pl::benchmarks
