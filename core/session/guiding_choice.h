// The choice between guided paths and paths of the baseline method for the passes of one film, by their efficiency: one over
// variance times cost. Variances are measured by paths; costs are counts of work times constants, never a clock, so that a picture
// can be reproduced. The principle is that of Grittmann et al. 2022, "Efficiency-Aware Multiple Importance Sampling for
// Bidirectional Rendering Algorithms", for whole passes.
#pragma once

#include <cstddef>
#include <optional>

#include "core/fields/field_shape.h"
#include "core/kernel/base/features.h"
#include "core/kernel/integrator/path.h"

namespace pl {

/// Whether guided methods may fall back to the baseline where guiding does not pay.
enum class GuidingRule : std::uint32_t {
    Paying,  ///< with light samples, passes are guided while guiding pays; without them, all are
    Always,  ///< every pass is guided
};

/// Time of the parts of a path, in any unit: only ratios count. Nanoseconds on one processor, rounded from
/// docs/notebook/2026-11-28-paths-in-lanes.md.
struct PathCosts {
    double segment = 0.0;   ///< of any path: tracing and shading
    double guidance = 0.0;  ///< of a guided path's segment, besides

    /// By the scene and the representation of the field alone, so that every back end makes the same choice.
    /// `learns`: whether paths train the field.
    static PathCosts of(std::size_t triangles, FeatureSet features, Representation representation, bool learns);

    double guided_segment() const { return segment + guidance; }
};

/// Variance and cost of the paths of one method: sums over passes, of which newer ones may weigh more.
class PathEfficiency {
public:
    /// `segment_cost`: of a segment of these paths.
    void add(const PassCounters& counters, double segment_cost);
    /// Reduces the weight of the passes so far to this share.
    void fade(double share);

    bool is_measured() const { return samples_ > 0.0; }
    double samples() const { return samples_; }
    double variance() const { return variance_ / samples_; }           ///< of a path's sample; NaN before the first
    double relative_variance() const { return relative_ / samples_; }  ///< over the squared mean; likewise
    double cost() const { return cost_ / paths_; }                     ///< of a path; NaN before the first
    /// Of the paths: those that bring light; NaN before the first.
    double lit_share() const { return lit_ / paths_; }

    /// As GuidingChoice::each_value().
    template <class Efficiency, class Fn>
    static void each_value(Efficiency& efficiency, Fn&& fn) {
        fn(efficiency.variance_);
        fn(efficiency.relative_);
        fn(efficiency.samples_);
        fn(efficiency.cost_);
        fn(efficiency.paths_);
        fn(efficiency.lit_);
    }

private:
    double variance_ = 0.0;
    double relative_ = 0.0;
    double samples_ = 0.0;  ///< measured ones
    double cost_ = 0.0;
    double paths_ = 0.0;
    double lit_ = 0.0;
};

/// The costs of paths, the picture and the field that a choice is about.
struct GuidingTerms {
    enum class Field {
        Learning,
        Coarse,
        Complete
    };  ///< learns from guided paths; a precomputed map, coarse or complete

    PathCosts costs{};
    double pixels = 1.0;   ///< of the picture
    double volumes = 1.0;  ///< of the field
    Field field = Field::Learning;
};

/// Paths of a part of the pixels that never come to the picture: they train the field or measure a method. Of one kind, or none.
struct Trial {
    bool is_guided = false;
    bool is_baseline = false;
    double passes = 0.0;  ///< of guided paths that the trial may have; 0: as few as suffice

    bool is_due() const { return is_guided || is_baseline; }
    friend bool operator==(Trial, Trial) = default;
};

class GuidingChoice {
public:
    /// Whether rounds of trials are due before the first pass: for a field that is unknown.
    bool is_warming_up() const { return !belief_; }
    std::uint32_t rounds() const { return rounds_; }
    /// The trial of the next round: first of the baseline, whose paths must train a field that learns, then guided ones. Their samples
    /// must form the film that variances are measured against.
    Trial warm_up_round(const GuidingTerms& terms) const;
    void measure_round(const PassCounters& guided, const PassCounters& baseline, const GuidingTerms& terms);

    /// Whether guided paths of the warm-up brought light far more often than those of the baseline: rare bright paths are then most of
    /// the variance of the first guided passes.
    bool found_hidden_light() const { return found_hidden_light_; }

    /// Whether passes are guided from now on, as far as is known.
    bool pays() const { return belief_.value_or(true); }
    /// The trial that is due before the pass of this number, of the method that passes do not use: two of the baseline before the first
    /// decision of a film, one of guided paths soon after a warm-up that gave up guiding; else as few as take kExploration of the time
    /// of all passes, the warm-up included. Those of guided paths become rare and large: many small ones would keep a device waiting.
    Trial trial_before(std::uint32_t pass) const;
    void measure_trial(std::uint32_t pass, const PassCounters& guided, const PassCounters& baseline,
                       const GuidingTerms& terms);
    /// After the pass of this number, and before the next choice; the counters are of all passes since the last one.
    void measure_pass(std::uint32_t pass, const PassCounters& counters, const GuidingTerms& terms);

    /// The choice for another film with the same field: the belief is kept until it is measured again.
    GuidingChoice restarted() const;
    /// Guides from the first pass on, by a field that is unknown.
    void begin_guided() { belief_ = belief_.value_or(true); }
    /// Guides from the first pass on, by a field that has learned before.
    void trust_field();

    /// Calls fn(value) for every value of its state, for checkpoints. `choice` may be const.
    template <class Choice, class Fn>
    static void each_value(Choice& choice, Fn&& fn) {
        const auto all = [&](auto&... values) { (fn(values), ...); };
        PathEfficiency::each_value(choice.guided_, fn);
        PathEfficiency::each_value(choice.baseline_, fn);
        all(choice.first_variance_, choice.guided_measurements_, choice.learned_, choice.rounds_,
            choice.baseline_trials_, choice.last_trial_, choice.spent_, choice.trial_cost_, choice.gain_,
            choice.gain_of_both_, choice.belief_, choice.found_hidden_light_);
    }

    /// Predicted equal-time factor of guiding over the baseline, by variance. Empty before the first decision of this film.
    std::optional<double> gain() const { return belief_ ? gain_ : std::nullopt; }

private:
    /// Share of the time of all passes that may be spent on trials.
    static constexpr double kExploration = 0.02;

    void measure_guided(const PassCounters& counters, const GuidingTerms& terms);
    void learn(std::uint64_t paths, const GuidingTerms& terms);
    void predict();
    double guided_cost() const;  ///< of a guided path, in paths of the baseline
    void spend(const PassCounters& guided, const PassCounters& baseline, const GuidingTerms& terms);
    /// Whether guided paths bring light far more often, so that the baseline's variance is only that of the light it has found.
    bool finds_hidden_light() const;
    double least_gain(const GuidingTerms& terms) const;
    /// Whether the guided rounds of a warm-up have measured a clear loss.
    bool loses_clearly() const;
    /// Whether the next trial is that after a warm-up which gave up guiding.
    bool takes_second_look() const;
    bool decides_after(std::uint32_t pass) const;
    void decide(const GuidingTerms& terms);

    PathEfficiency guided_;
    PathEfficiency baseline_;
    std::optional<double> first_variance_;  ///< of guided paths, after a few measurements
    std::uint32_t guided_measurements_ = 0;
    double learned_ = 0.0;                     ///< paths per volume of the field that have trained it so far
    std::uint32_t rounds_ = 0;                 ///< of the warm-up
    std::uint32_t baseline_trials_ = 0;        ///< after it
    std::optional<std::uint32_t> last_trial_;  ///< number of the pass after it
    double spent_ = 0.0;                       ///< on rounds and trials, in passes of the baseline
    double trial_cost_ = 0.0;                  ///< likewise, on the last one
    std::optional<double> gain_;
    double gain_of_both_ = 0.0;        ///< geometric mean of gain_ and that by relative variance, bounded
    std::optional<bool> belief_;       ///< whether guiding pays
    bool found_hidden_light_ = false;  ///< by the warm-up
};

}  // namespace pl
