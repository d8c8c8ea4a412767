// The choice between guided paths and paths of the baseline method for the passes of one film, by the relative variance of single
// paths. It is made a few times from paths that both methods trace against the same means, and never by a clock, so that a picture can be
// reproduced (docs/theory.md, "Guide or not").
#pragma once

#include <optional>

#include "core/kernel/integrator/path.h"

namespace pl {

/// Whether guided methods may fall back to the baseline where guiding does not pay.
enum class GuidingRule : std::uint32_t {
    Paying,  ///< with light samples, passes are guided if guiding pays; without them, all are
    Always,  ///< every pass is guided
};

/// The noise of the paths of one method: sums over passes.
class PathNoise {
public:
    void add(const PassCounters& counters);

    bool is_measured() const { return samples_ > 0.0; }
    double variance() const { return variance_ / samples_; }  ///< relative, of a path's sample; NaN before the first
    double lit_share() const { return lit_ / paths_; }        ///< of paths that bring light; NaN before the first

    /// As GuidingChoice::each_value().
    template <class Noise, class Fn>
    static void each_value(Noise& noise, Fn&& fn) {
        fn(noise.variance_);
        fn(noise.samples_);
        fn(noise.lit_);
        fn(noise.paths_);
    }

private:
    double variance_ = 0.0;
    double samples_ = 0.0;  ///< measured
    double lit_ = 0.0;
    double paths_ = 0.0;
};

/// Paths of a part of the pixels, which never come to the picture: they measure a method, or train the field.
enum class Trial : std::uint32_t { None, Baseline, Guided };

/// A film decides before its first pass, if it warms up, and once more before a later one. Both methods are measured in the last four
/// passes before the decision; in a warm-up, whose rounds have the same course, four samples of each measured pixel make the means, then
/// both methods are measured four times.
class GuidingChoice {
public:
    static constexpr std::uint32_t kMeasured = 4;  ///< passes, or rounds of a warm-up
    /// The pass that is decided about; of a warm-up, its number of rounds.
    static constexpr std::uint32_t kDecision = 8;
    /// The same for a film whose warm-up gave guiding up: earlier, trials of guided paths would take the time of passes that a short film lacks.
    static constexpr std::uint32_t kLateDecision = 64;

    bool is_measured(std::uint32_t pass) const { return pass + kMeasured >= decision_ && pass < decision_; }
    /// Whether trials or a decision may be due before this pass.
    bool is_due_before(std::uint32_t pass) const { return pass == 0 || is_measured(pass) || pass == decision_; }
    /// The least ratio of variances at which guiding pays. `guidance`: the time of guidance at a vertex, relative to a table.
    static double least_ratio(double guidance);

    /// Whether trials of a warm-up are due before the first pass: for a field that is unknown.
    bool is_warming_up() const { return !belief_; }
    /// The next trial of the warm-up. The first rounds are of the baseline, whose paths must train a field that learns; each further one,
    /// which is measured, is of the baseline and then of guided paths.
    Trial warm_up_trial() const;
    std::uint32_t warm_up_round() const;
    bool is_round_measured() const { return warm_up_round() + kMeasured >= kDecision; }
    void measure_warm_up(const PassCounters& counters, double least_ratio);
    /// Whether guided paths of the warm-up brought light far more often than paths of the baseline: rare bright paths are then most of
    /// the variance of the first guided passes.
    bool found_hidden_light() const { return found_hidden_light_; }

    /// Whether passes are guided from now on, as far as is known.
    bool pays() const { return belief_.value_or(true); }
    /// The trial that is due before the pass of this number, of the method that passes do not use.
    Trial trial_before(std::uint32_t pass) const;
    void measure_trial(std::uint32_t pass, const PassCounters& counters);
    /// After a pass that is_measured(). The last one decides.
    void measure_pass(std::uint32_t pass, const PassCounters& counters, double least_ratio);

    /// The choice for another film with the same field: the belief is kept until it is measured again.
    GuidingChoice restarted() const;
    /// Guides from the first pass on, without a warm-up, unless guiding is known not to pay.
    void begin_guided() { belief_ = pays(); }

    /// Calls fn(value) for every value of its state, for checkpoints. `choice` may be const.
    template <class Choice, class Fn>
    static void each_value(Choice& choice, Fn&& fn) {
        PathNoise::each_value(choice.guided_, fn);
        PathNoise::each_value(choice.baseline_, fn);
        fn(choice.warm_up_trials_);
        fn(choice.last_trial_);
        fn(choice.decision_);
        fn(choice.ratio_);
        fn(choice.belief_);
        fn(choice.found_hidden_light_);
    }

    /// Relative variance of a path of the baseline, over the relative variance of a guided path. Empty before the first decision of this film.
    std::optional<double> variance_ratio() const { return ratio_; }

private:
    void decide(double least_ratio);
    /// Whether guided paths bring light far more often, so that the baseline's variance is only the variance of the light that it has found.
    bool finds_hidden_light() const;

    PathNoise guided_;
    PathNoise baseline_;
    std::uint32_t warm_up_trials_ = 0;
    std::uint32_t last_trial_ = 0;        ///< the pass after it; 0 before the first
    std::uint32_t decision_ = kDecision;  ///< the pass that is decided about
    std::optional<double> ratio_;
    std::optional<bool> belief_;  ///< whether guiding pays
    bool found_hidden_light_ = false;
};

}  // namespace pl
