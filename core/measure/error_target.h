// Budgets of measurements, and rendering until the noise of a picture meets a target.
#pragma once

#include <cstdint>
#include <optional>

#include "core/session/session.h"

namespace pl {

/// Seconds spent on measuring, compared with the seconds charged to the runs.
class MeasureBudget {
public:
    static constexpr double kDefaultShare = 0.01;

    /// An infinite share allows everything.
    explicit MeasureBudget(double share = kDefaultShare) : share_(share) {}

    /// Whether so many more measurements, each as long as the last one, keep within the share.
    bool allows(double charged_seconds, int measurements = 1) const {
        return !(spent_seconds_ + measurements * last_seconds_ > share_ * charged_seconds);
    }
    void spend(double seconds) {
        spent_seconds_ += seconds;
        note(seconds);
    }
    /// A measurement made in any case, on no budget; the next one is expected to take as long.
    void note(double seconds) { last_seconds_ = seconds; }
    /// Measurements to come take so much longer than the last one.
    void expect_more(double seconds) { last_seconds_ += seconds; }
    double spent_seconds() const { return spent_seconds_; }

private:
    double share_;
    double spent_seconds_ = 0.0;
    double last_seconds_ = 0.0;
};

/// Measures a picture from time to time; the measurements stay within their share of the charged time.
class ErrorTarget {
public:
    /// `target` is the relMSE of the noise as estimated from the picture's two halves (Noise::relmse).
    explicit ErrorTarget(double target) : target_(target) {}

    /// To be called after each pass. Noise is not measured below kFewestSamples: a picture whose paths have not yet
    /// found the light is black and without noise.
    bool is_met(const Session& session, FilmSlot slot);
    /// Measures the finished picture, even beyond the budget.
    void measure_last(const Session& session, FilmSlot slot);
    /// By the last measurement.
    bool is_low_enough() const { return measured_ && *measured_ <= target_; }

    double target() const { return target_; }
    /// The last measurement; empty if there is none, if the film lacks a second half or has no finite pixel.
    std::optional<double> measured() const { return measured_; }
    /// Share of the time to the target that has passed, if errors fall as 1 / samples.
    double share_done() const;

    static constexpr std::uint32_t kFewestSamples = 16;

private:
    void measure(const Session& session, FilmSlot slot);

    double target_;
    MeasureBudget budget_;
    std::optional<double> measured_;
    std::uint32_t measured_passes_ = 0;
    std::uint32_t next_passes_ = 2;
};

}  // namespace pl
