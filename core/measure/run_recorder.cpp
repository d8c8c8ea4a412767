#include "core/measure/run_recorder.h"

#include <algorithm>

#include "core/base/timer.h"

namespace pl {
namespace {

/// Sums of two halves of the passes of one film, told apart by reading the film between them.
class HalfSums {
public:
    /// Adds the passes since the last call to one half.
    void add(std::size_t half, Pixels film, std::uint32_t passes) {
        if (read_.empty()) {
            read_.assign(film.size(), Vec3d(0.0));
            for (auto& sum : sums_) sum.assign(film.size(), Vec3d(0.0));
        }
        for (std::size_t i = 0; i < film.size(); ++i) {
            const Vec3d total = Vec3d{film[i]} * static_cast<double>(passes);
            sums_[half][i] += total - read_[i];
            read_[i] = total;
        }
        passes_[half] += passes - read_passes_;
        read_passes_ = passes;
    }

    bool balanced() const { return passes_[0] == passes_[1] && passes_[0] > 0; }
    std::uint32_t passes() const { return passes_[0] + passes_[1]; }

    std::vector<Vec3f> mean(std::size_t half) const {
        std::vector<Vec3f> result(read_.size());
        const double scale = 1.0 / static_cast<double>(passes_[half]);
        for (std::size_t i = 0; i < result.size(); ++i) result[i] = Vec3f{sums_[half][i] * scale};
        return result;
    }

private:
    std::vector<Vec3d> read_;
    std::uint32_t read_passes_ = 0;
    std::vector<Vec3d> sums_[2];
    std::uint32_t passes_[2] = {0, 0};
};

class RunRecorder {
public:
    RunRecorder(const RunLimits& limits, const ReferenceHalves& reference, const RunObserver& observer)
        : limits_(limits), reference_(reference), observer_(observer) {}

    /// After every sample per pixel; true when the run is over.
    bool observe(const Session& session) {
        const std::uint32_t spp = session.passes();
        bool over = spp >= limits_.spp || (limits_.seconds && charged_seconds(session.clocks()) >= *limits_.seconds);
        if (!over && spp != middle() && spp != next_) return false;
        const Stopwatch watch;
        const Snapshot snapshot = session.snapshot();
        if (spp == middle()) halves_.add(0, snapshot.pixels, spp);
        if (spp == next_) finish_step(snapshot);
        const bool measured = over || spp == last_;
        if (measured) {
            measure(snapshot);
            over = over || (limits_.target_error && series_.points.back().metrics.relmse <= *limits_.target_error);
        }
        series_.measure_seconds += watch.seconds();
        if (observer_.on_point && measured) observer_.on_point(series_.points.back(), snapshot);
        return over;
    }

    RunSeries take() { return std::move(series_); }

private:
    std::uint32_t middle() const { return last_ + (next_ - last_) / 2; }

    void finish_step(const Snapshot& snapshot) {
        halves_.add(1, snapshot.pixels, snapshot.passes);
        last_ = next_;
        next_ = next_ladder_step(last_);
    }

    void measure(const Snapshot& snapshot) {
        RunPoint point{.spp = snapshot.passes,
                       .clocks = snapshot.clocks,
                       .metrics = measure_error(snapshot.pixels, reference_),
                       .noise = {},
                       .squared_bias = {},
                       .signed_bias = {},
                       .counters = snapshot.counters};
        if (last_ > 0) {
            if (parts_passes_ != last_) take_halves_apart(snapshot.width);
            point.noise = parts_.variance * static_cast<double>(last_) / static_cast<double>(point.spp);
            point.squared_bias = parts_.squared_bias;
            point.signed_bias = parts_.signed_bias;
        }
        series_.points.push_back(point);
    }

    void take_halves_apart(int width) {
        if (!halves_.balanced()) return;
        const std::vector<Vec3f> first = halves_.mean(0);
        const std::vector<Vec3f> second = halves_.mean(1);
        parts_ = take_apart({first, second}, reference_, width);
        parts_passes_ = last_;
    }

    RunLimits limits_;
    ReferenceHalves reference_;
    const RunObserver& observer_;
    RunSeries series_;
    HalfSums halves_;
    ErrorParts parts_;
    std::uint32_t parts_passes_ = 0;
    std::uint32_t last_ = 0;  ///< step of the ladder that both halves have reached
    std::uint32_t next_ = next_ladder_step(0);
};

}  // namespace

double charged_seconds(const Clocks& clocks) {
    return clocks.place + clocks.precompute + clocks.learn + clocks.render;
}

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

std::optional<RunSeries> record_run(Session& session, const RunLimits& limits, const ReferenceHalves& reference,
                                    const StopFlag* stop, const RunObserver& observer) {
    RunRecorder recorder(limits, reference, observer);
    for (;;) {
        const Progress progress = session.advance(stop);
        if (progress == Progress::Stopped || (stop != nullptr && *stop)) return std::nullopt;
        if (progress == Progress::Rendered && recorder.observe(session)) return recorder.take();
        if (observer.on_work) observer.on_work(session);
    }
}

}  // namespace pl
