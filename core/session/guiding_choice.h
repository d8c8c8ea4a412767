// The choice between guided paths and paths of the baseline method for the passes of one film, by the relative variance of single
// paths. All passes stay in the picture. The choice is made a few times, from passes by both methods against the same means, and never by
// a clock, so that a picture can be reproduced (docs/theory.md, "Guide or not").
#pragma once

#include <optional>

#include "core/kernel/film/pass_schedule.h"
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
    /// Adds paths of a pass.
    void add_paths(const PassCounters& counters);
    /// Adds the relative variances of so many samples: the sums of their estimates and of the squares of these.
    void add_variance(double total, double squares, std::uint64_t samples);

    bool is_measured() const { return samples_ > 0.0; }
    double samples() const { return samples_; }
    double variance() const { return variance_ / samples_; }  ///< relative, of a path's sample; NaN before the first
    /// The squared standard error of variance(), over its square.
    double squared_error() const { return (squares_ / (variance() * variance()) - samples_) / (samples_ * samples_); }
    double lit_share() const { return lit_ / paths_; }  ///< of paths that bring light; NaN before the first

    /// As GuidingChoice::each_value().
    template <class Noise, class Fn>
    static void each_value(Noise& noise, Fn&& fn) {
        fn(noise.variance_);
        fn(noise.squares_);
        fn(noise.samples_);
        fn(noise.lit_);
        fn(noise.paths_);
    }

private:
    double variance_ = 0.0;
    double squares_ = 0.0;
    double samples_ = 0.0;  ///< measured
    double lit_ = 0.0;
    double paths_ = 0.0;
};

/// What a pass is for, besides the picture.
enum class PassRole : std::uint32_t {
    None,      ///< by the method that was chosen
    Training,  ///< paths of the baseline train the field, and are measured against guided ones
    Baseline,  ///< paths of the baseline are measured
    Guided,    ///< guided paths are measured
};

/// A film of an unknown field begins with a warm-up: passes that train and guided passes, as many of each, and then decides. Later it asks
/// again by as many passes of the method that it has not chosen and of the method that it has, and decides anew. Which passes these are,
/// and their weights, depends on their numbers alone: PassSchedule.
class GuidingChoice {
public:
    /// Begins the film. `is_known`: the field has been trained.
    void begin_film(std::uint32_t pixels, bool is_known);
    /// The choice for another film with the same field: the belief is kept until it is measured again.
    GuidingChoice restarted() const;

    /// The least ratio of variances at which guiding pays, after a warm-up and after a later question. `guidance`: the time of guidance at a
    /// vertex, relative to a table.
    static double least_ratio(double guidance, bool is_warm_up);

    /// Whether passes are guided from now on, as far as is known.
    bool pays() const { return belief_.value_or(true); }
    /// Of passes by this choice.
    const PassSchedule& schedule() const { return schedule_; }
    bool is_warm_up(std::uint32_t pass) const { return pass < schedule_.warm_up; }

    PassRole role_of(std::uint32_t pass) const;
    bool is_guided(std::uint32_t pass) const;
    VarianceMeasure measure_of(std::uint32_t pass) const;
    /// Takes the measurements of a pass that has ended, and decides if it is the last one of a question.
    void finish_pass(std::uint32_t pass, const PassCounters& counters, double guidance);

    /// Relative variance of a path of the baseline, over the relative variance of a guided path. Empty before the first decision of this film.
    std::optional<double> variance_ratio() const { return ratio_; }
    /// The factor that variance_ratio() may be off by, up or down: its bounds of 95 %, by the delta method.
    double ratio_factor() const { return ratio_factor_; }

    /// Calls fn(value) for every value of its state, for checkpoints. `choice` may be const.
    template <class Choice, class Fn>
    static void each_value(Choice& choice, Fn&& fn) {
        PathNoise::each_value(choice.guided_, fn);
        PathNoise::each_value(choice.baseline_, fn);
        fn(choice.schedule_.each);
        fn(choice.schedule_.warm_up);
        fn(choice.products_);
        fn(choice.ratio_);
        fn(choice.ratio_factor_);
        fn(choice.belief_);
    }

private:
    void measure_ratio(bool is_warm_up);
    void decide(double least_ratio, bool is_warm_up);

    PathNoise guided_;
    PathNoise baseline_;
    double products_ = 0.0;  ///< of both variances in a pixel of a warm-up, summed
    PassSchedule schedule_{};
    std::optional<double> ratio_;
    double ratio_factor_ = 1.0;
    std::optional<bool> belief_;  ///< whether guiding pays
};

}  // namespace pl
