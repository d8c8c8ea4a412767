// One run of one method, measured while it converges: error and noise at log-spaced points, and what they cost. Measuring
// is between passes, so it is on none of the clocks that are charged.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/measure/convergence.h"
#include "core/measure/halves.h"
#include "core/measure/measure_budget.h"
#include "core/session/session.h"

namespace pl {

/// What a method is charged for: placing volumes, precomputing, learning and rendering. Loading and building are the
/// same for all methods, and not in it.
double charged_seconds(const Clocks& clocks);

/// Threads to measure with: those that wait meanwhile, or all where a device renders.
int measuring_threads(const Session& session);

/// When a run ends: at the first limit that is met, after at least one sample per pixel.
struct RunLimits {
    std::uint32_t spp = 64;
    std::optional<double> seconds{};       ///< charged
    std::optional<double> target_error{};  ///< Metrics::relmse, looked at where it is measured
    /// Of the charged time, what measuring may take; points are left out for it, but for the first and the last one.
    double measure_share = MeasureBudget::kDefaultShare;
};

struct RunPoint {
    std::uint32_t spp = 0;
    Clocks clocks;
    Metrics metrics;
    /// The picture's own noise as relmse, from two halves of its passes, and the bias that they leave. Empty below two
    /// samples.
    std::optional<double> noise{};
    std::optional<Estimate> squared_bias{};
    std::optional<Estimate> signed_bias{};
    PassCounters counters;
};

struct RunSeries {
    std::vector<RunPoint> points;
    double measure_seconds = 0.0;  ///< spent on measuring, without observers: not charged

    Curve error_over_time() const;
    Curve error_over_samples() const;
};

/// 2, 4, 6, 8, 12, 16, 24, ...: the next step above `spp`. About seven in a decade, all even.
std::uint32_t next_ladder_step(std::uint32_t spp);

/// What a run tells while it goes on; all may be empty.
struct RunObserver {
    /// After each measured point, with the picture. Its time is not charged either.
    std::function<void(const RunPoint&, const Snapshot&)> on_point{};
    /// After each piece of work.
    std::function<void(const Session&, FilmSlot)> on_work{};
};

/// Renders a film of a fresh session until a limit is met. Empty if `stop` was raised before: half a run measures nothing.
/// Throws Error(Input) unless the reference has the session's size.
std::optional<RunSeries> record_run(Session& session, FilmSlot slot, const RunLimits& limits,
                                    const ReferenceHalves& reference, const StopFlag* stop = nullptr,
                                    const RunObserver& observer = {});

}  // namespace pl
