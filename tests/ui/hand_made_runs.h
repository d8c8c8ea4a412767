// Runs with known errors, for tests of plots, tables and comparisons.
#pragma once

#include <memory>
#include <vector>

#include "core/measure/live_runs.h"

namespace pl::test {

inline constexpr std::uint64_t kThisPicture = 7;

/// A picture of one color; `half` is the bits of a half float.
inline std::shared_ptr<const HalfPicture> plain_picture(std::uint16_t half, int width = 4, int height = 2) {
    auto picture = std::make_shared<HalfPicture>();
    picture->width = width;
    picture->height = height;
    picture->rgb.assign(static_cast<std::size_t>(3 * width * height), half);
    return picture;
}

struct RunRecipe {
    std::uint64_t number = 1;
    MethodId method = MethodId::Default;
    double setup_seconds = 0.0;
    double seconds_per_sample = 0.1;
    double error_of_sample = 1.0;  ///< relMSE falls from it as 1 / samples
    std::uint32_t last_sample = 128;
    bool in_progress = false;
    bool with_reference = true;
    std::uint64_t picture = kThisPicture;
};

/// Points at 1, 2, 4, ... samples.
inline std::shared_ptr<LiveRun> make_run(const RunRecipe& recipe) {
    auto run = std::make_shared<LiveRun>();
    run->number = recipe.number;
    run->label.method = recipe.method;
    run->label.backend = "cpu";
    run->label.picture = recipe.picture;
    run->in_progress = recipe.in_progress;
    for (std::uint32_t spp = 1; spp <= recipe.last_sample; spp *= 2) {
        LivePoint point;
        point.spp = spp;
        point.clocks.precompute = recipe.setup_seconds;
        point.clocks.render = recipe.seconds_per_sample * spp;
        point.noise = recipe.error_of_sample / spp;
        if (recipe.with_reference) {
            point.metrics.emplace();
            point.metrics->relmse = recipe.error_of_sample / spp;
        }
        point.picture = plain_picture(static_cast<std::uint16_t>(0x3c00 + spp));
        run->points.push_back(point);
    }
    return run;
}

using Runs = std::vector<std::shared_ptr<const LiveRun>>;

/// Default: 0.1 s a sample. Reinforcement: a quarter of the error in twice the time.
inline Runs two_runs() {
    return {make_run({.number = 1}), make_run({.number = 2,
                                               .method = MethodId::Reinforcement,
                                               .seconds_per_sample = 0.2,
                                               .error_of_sample = 0.25,
                                               .in_progress = true})};
}

}  // namespace pl::test
