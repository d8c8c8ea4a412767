// The choice between guided passes and passes of the baseline method for one film, by their efficiency: one over variance
// times cost. Variances are measured by the passes themselves; costs are counts of work times constants, never a clock, so
// that a picture can be reproduced. The principle is that of Grittmann et al. 2022, "Efficiency-Aware Multiple Importance
// Sampling for Bidirectional Rendering Algorithms", for whole passes.
#pragma once

#include <cstddef>
#include <optional>

#include "core/kernel/base/features.h"
#include "core/kernel/integrator/path.h"

namespace pl {

/// Whether guided methods may fall back to the baseline where guiding does not pay.
enum class GuidingRule : std::uint32_t {
    Paying,  ///< with light samples, passes are guided while guiding pays; without them, all are
    Always,  ///< every pass is guided
};

/// Time of the parts of a path, in any unit: only ratios count. Nanoseconds on one processor, rounded from
/// docs/notebook/2026-11-23-guiding-choice.md.
struct PathCosts {
    double segment = 0.0;   ///< of any path: tracing and shading
    double guidance = 0.0;  ///< of a guided path's segment, besides

    /// By the scene alone, so that every back end makes the same choice.
    static PathCosts of(std::size_t triangles, FeatureSet features);

    /// Of the mean path of some passes.
    double of_path(const PassCounters& counters) const;
};

class GuidingChoice {
public:
    /// Whether a trial, some paths of the baseline method that do not come to the film, is due before the pass of this number.
    bool is_trial_due(std::uint32_t pass) const;
    /// Whether the pass of this number is guided. Where guiding does not pay, some passes are still guided, to learn and to
    /// measure again: as few as lose kExploration of the efficiency of all.
    bool guides(std::uint32_t pass) const;

    void measure_trial(const PassCounters& trial);
    /// After a complete pass that was not guided.
    void measure_unguided(const PassCounters& counters) { baseline_ += counters; }
    /// After the complete guided pass of this number; the first ones are not measured.
    void measure_guided(std::uint32_t pass, const PassCounters& counters, const PathCosts& costs);

    /// Predicted equal-time factor of guiding over the baseline. Empty before the first decision.
    std::optional<double> gain() const { return gain_; }
    /// Whether passes are guided from now on, as far as is known.
    bool pays() const { return pays_; }

private:
    /// Share of all passes that may be lost to guided ones where guiding does not pay.
    static constexpr double kExploration = 0.02;

    PassCounters baseline_{};  ///< of all trials and unguided passes
    std::uint32_t trials_ = 0;
    double variance_ = 0.0;  ///< weighted sum over guided passes, newer ones weigh more
    double cost_ = 0.0;      ///< likewise, of a path
    double weight_ = 0.0;
    double loss_per_pass_ = 0.0;  ///< passes of the baseline that a guided one costs more than it brings
    double lost_ = 0.0;           ///< likewise, of all passes so far
    std::optional<double> gain_;
    bool pays_ = true;
};

}  // namespace pl
