// The passes of a film by their numbers alone: their random numbers, their weights, and when they ask whether guiding pays.
#pragma once

#include <cstdint>

#include "core/kernel/base/math.h"

namespace pl {

/// Fixed before the first pass: weights that depended on the samples would be a bias. [Mueller et al. 2017, section 5.1, leave out the
/// samples of early iterations instead]
struct PassSchedule {
    std::uint32_t first_sample = 0;  ///< of the first pass, were it no part of a warm-up
    std::uint32_t trained = 0;       ///< passes that have trained the field before the first one
    std::uint32_t ramp = 1;     ///< trained passes until the weight is constant, where there is no choice of guiding
    std::uint32_t each = 0;     ///< passes of a role, see PassRole; 0: there is no choice
    std::uint32_t warm_up = 0;  ///< passes of the warm-up: two roles, or none

    /// Samples of a learning method that are kept for the training passes of a warm-up.
    static constexpr std::uint32_t kTrainingSamples = 8;

    /// Weights of training passes of a warm-up and of the other method's passes in a question, of guided passes of a warm-up, and of all
    /// others. Weights by the inverses of variances, which are unknown beforehand, would be best
    /// (docs/notebook/2026-11-30-all-passes-stay.md has what these lose).
    static constexpr std::uint32_t kWeightOfQuestion = 1;
    static constexpr std::uint32_t kWeightOfYoungField = 4;
    static constexpr std::uint32_t kWeight = 8;

    /// The pass of the first question: after a warm-up; and without one, in a picture that begins by the choice of another one.
    static constexpr std::uint32_t kFirstQuestion = 128;
    static constexpr std::uint32_t kEarlyQuestion = 8;
    /// Each further question comes so many times as late.
    static constexpr std::uint32_t kQuestionFactor = 4;

    /// The number of a pass for its random numbers. Training passes of a warm-up have odd numbers and its guided passes even ones: each
    /// have a half of the film of their own.
    PL_HD std::uint32_t sample_of(std::uint32_t pass) const {
        if (pass >= warm_up) return first_sample + pass;
        return pass < each ? 2 * pass + 1 : first_sample + 2 * (pass - each);
    }

    /// The number of passes since the beginning of the question that a pass after the warm-up belongs to, below 2 * each; else 2 * each.
    PL_HD std::uint32_t since_question(std::uint32_t pass) const {
        std::uint64_t first = warm_up > 0 ? kFirstQuestion : kEarlyQuestion;
        while (first + 2 * each <= pass) first = first < kFirstQuestion ? kFirstQuestion : kQuestionFactor * first;
        return pass >= first ? static_cast<std::uint32_t>(pass - first) : 2 * each;
    }

    PL_HD std::uint32_t weight_of(std::uint32_t pass) const {
        if (each == 0) return min_of(min_of(trained, ramp) + min_of(pass, ramp) + 1, ramp);
        if (pass < warm_up) return pass < each ? kWeightOfQuestion : kWeightOfYoungField;
        return since_question(pass) < each ? kWeightOfQuestion : kWeight;
    }
};

}  // namespace pl
