// One run of one method, measured while it converges: error, noise and cost at log-spaced points. Measurements are
// made between passes, so they are on none of the charged clocks.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/measure/convergence.h"
#include "core/measure/error_target.h"
#include "core/measure/halves.h"
#include "core/session/session.h"

namespace pl {

/// Seconds that count for a method: placing volumes, precomputing, learning and rendering. Loading and building are
/// the same for all methods and do not count.
double charged_seconds(const Clocks& clocks);

/// Threads for measuring: as many as the back end renders with, which wait meanwhile, or all if a device renders.
int measuring_threads(const Session& session);

/// Limits of a run: it ends at the first one that is reached, after at least one sample per pixel. Passes between two points may be
/// rendered at once; time is looked at after as many as the back end takes.
struct RunLimits {
    std::uint32_t spp = 64;
    std::optional<double> seconds{};       ///< charged
    std::optional<double> target_error{};  ///< Metrics::relmse, compared at measured points
    /// Time for measuring relative to the charged time; points are left out to keep within it, except for the first
    /// and the last one.
    double measure_share = MeasureBudget::kDefaultShare;
};

struct RunPoint {
    std::uint32_t spp = 0;
    Clocks clocks;
    Metrics metrics;
    /// Noise as relmse, estimated from two halves of the passes, and the bias by the same halves. Empty below two
    /// samples.
    std::optional<double> noise{};
    std::optional<Estimate> squared_bias{};
    std::optional<Estimate> signed_bias{};
    PassCounters counters;
};

struct RunSeries {
    std::vector<RunPoint> points;
    double measure_seconds = 0.0;  ///< for measuring, without observers; not charged

    Curve error_over_time() const;
    Curve error_over_samples() const;
};

/// 2, 4, 6, 8, 12, 16, 24, ...: the next step above `spp`. About seven in a decade, all even.
std::uint32_t next_ladder_step(std::uint32_t spp);

/// Watches a run; both members may be empty.
struct RunObserver {
    /// After each measured point, with the picture. Its time is not charged either.
    std::function<void(const RunPoint&, const Snapshot&)> on_point{};
    /// After each piece of work.
    std::function<void(const Session&, FilmSlot)> on_work{};
};

/// Renders in a fresh session until a limit is reached. Empty if `stop` is raised before: half a run measures
/// nothing. Throws Error(Input) unless the reference has the size of the session.
std::optional<RunSeries> record_run(Session& session, FilmSlot slot, const RunLimits& limits,
                                    const PictureHalves& reference, const StopFlag* stop = nullptr,
                                    const RunObserver& observer = {});

}  // namespace pl
