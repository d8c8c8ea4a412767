#include "core/measure/run_recorder.h"

#include <algorithm>

#include "core/base/timer.h"

namespace pl {
namespace {

class RunRecorder {
public:
    RunRecorder(const RunLimits& limits, const PictureHalves& reference, const RunObserver& observer)
        : limits_(limits), reference_(reference), observer_(observer), budget_(limits.measure_share) {}

    /// Passes until the next one after which the film may be measured.
    std::uint32_t most_passes(const Session& session, FilmSlot slot) const {
        const std::uint32_t spp = session.passes(slot);
        const std::uint32_t last = std::min(next_, limits_.spp);
        return last > spp ? last - spp : 1;
    }

    /// After every call that has rendered; true when the run is over.
    bool observe(const Session& session, FilmSlot slot) {
        const std::uint32_t spp = session.passes(slot);
        const double charged = charged_seconds(session.clocks(slot));
        bool over = spp >= limits_.spp || (limits_.seconds && charged >= *limits_.seconds);
        const bool due = spp >= next_;
        if (due) next_ = next_ladder_step(spp);
        // The budget must cover the last point besides this one.
        if (!over && !(due && budget_.allows(charged, 2))) return false;
        const Stopwatch watch;
        const Snapshot snapshot = session.snapshot_with_halves(slot);
        const RunPoint& point = series_.points.emplace_back(measure(snapshot, measuring_threads(session)));
        over = over || (limits_.target_error && point.metrics.relmse <= *limits_.target_error);
        budget_.spend(watch.seconds());
        if (observer_.on_point) observer_.on_point(point, snapshot);
        return over;
    }

    RunSeries take() {
        series_.measure_seconds = budget_.spent_seconds();
        return std::move(series_);
    }

private:
    RunPoint measure(const Snapshot& snapshot, int threads) const {
        RunPoint point{.spp = snapshot.passes,
                       .clocks = snapshot.clocks,
                       .metrics = measure_error(snapshot.pixels, reference_, threads),
                       .noise = {},
                       .squared_bias = {},
                       .signed_bias = {},
                       .counters = snapshot.counters};
        if (!snapshot.halves.are_both_there()) return point;
        const ErrorParts parts = take_apart(halves_of(snapshot.halves), reference_, snapshot.width, threads);
        point.noise = parts.variance;
        point.squared_bias = parts.squared_bias;
        point.signed_bias = parts.signed_bias;
        return point;
    }

    RunLimits limits_;
    PictureHalves reference_;
    const RunObserver& observer_;
    RunSeries series_;
    MeasureBudget budget_;
    std::uint32_t next_ = next_ladder_step(0);
};

}  // namespace

double charged_seconds(const Clocks& clocks) {
    return clocks.place + clocks.precompute + clocks.learn + clocks.render;
}

int measuring_threads(const Session& session) { return session.backend().free_threads(); }

Curve RunSeries::error_over_time() const {
    Curve curve;
    for (const RunPoint& point : points) curve.push_back({charged_seconds(point.clocks), point.metrics.relmse});
    return curve;
}

Curve RunSeries::error_over_samples() const {
    Curve curve;
    for (const RunPoint& point : points) curve.push_back({static_cast<double>(point.spp), point.metrics.relmse});
    return curve;
}

std::uint32_t next_ladder_step(std::uint32_t spp) {
    std::uint32_t step = 2;
    while (step <= spp) {
        const std::uint32_t between = step + step / 2;  // odd for 2 only
        if (step > 2 && between > spp) return between;
        step *= 2;
    }
    return step;
}

std::optional<RunSeries> record_run(Session& session, FilmSlot slot, const RunLimits& limits,
                                    const PictureHalves& reference, const StopFlag* stop,
                                    const RunObserver& observer) {
    RunRecorder recorder(limits, reference, observer);
    for (;;) {
        const Progress progress = session.advance(slot, stop, recorder.most_passes(session, slot));
        if (progress == Progress::Stopped || (stop != nullptr && *stop)) return std::nullopt;
        if (progress == Progress::Rendered && recorder.observe(session, slot)) return recorder.take();
        if (observer.on_work) observer.on_work(session, slot);
    }
}

}  // namespace pl
