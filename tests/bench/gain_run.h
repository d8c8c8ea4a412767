// One run of gain_bench: a method and a seed, measured along the way, so that it has results at every length.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/measure/metrics.h"
#include "core/session/settings.h"

namespace pl::benchmarks {

/// Names of the squared errors: of all pixels, without the worst 0.1 % and without the worst 1 %.
inline constexpr std::array kErrorNames{"mse", "mse_0.1", "mse_1", "relmse", "relmse_0.1", "relmse_1"};
using Errors = std::array<double, kErrorNames.size()>;

Errors errors_of(Pixels picture, const PictureHalves& reference);

struct Checkpoint {
    std::uint32_t samples = 0;  ///< per pixel
    double seconds = 0.0;       ///< of all processors: placing, precomputing, learning and rendering, not measuring
    Errors errors{};
};

struct GainRun {
    std::uint64_t seed = 0;
    std::vector<Checkpoint> points;  ///< ascending
    double dark_share = 0.0;         ///< of the paths: those that bring no light
};

/// A run ends when it has all samples and all seconds.
struct RunLength {
    std::vector<std::uint32_t> samples{};  ///< per pixel, ascending, not empty; each of them is a checkpoint
    double seconds = 0.0;                  ///< the first pass that ends at or after them is a checkpoint
};

/// What runs of a scene have in common.
struct RunSetting {
    std::shared_ptr<const SceneDescription> scene;
    RenderSettings settings;  ///< but for method and seed
    PictureHalves reference;
    RunLength length;
    int threads = 1;
};

/// Further checkpoints are powers of two up to 32 and multiples of 32 samples.
GainRun measure_run(const RunSetting& setting, MethodId method, std::uint64_t seed);

/// A run of the yardstick of uniform_sampling.h: one checkpoint at the last of the wanted samples, without time.
GainRun measure_uniform(const RunSetting& setting, std::uint64_t seed);

}  // namespace pl::benchmarks
