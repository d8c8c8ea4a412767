// Rendering until the noise of a picture meets a target.
#pragma once

#include <cstdint>
#include <optional>

#include "core/measure/measure_budget.h"
#include "core/session/session.h"

namespace pl::bench {

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

}  // namespace pl::bench
