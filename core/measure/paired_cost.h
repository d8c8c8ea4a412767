// Cost of one kind of pass relative to another, from passes in turns: both see the same state of the machine.
#pragma once

#include <vector>

#include "core/measure/statistics.h"

namespace pl {

/// Pairs of passes, one of each kind. Every second pair begins with the other kind, so that a slow drift of the
/// machine favors neither. The first pair is a warm-up and does not count. The number of pairs is fixed beforehand: a
/// stopping rule that looks at the interval would make it too narrow.
class PairedCost {
public:
    static constexpr std::size_t kPairs = 32;

    /// Seconds of a pass of each kind, and their ratio, as geometric means over pairs.
    struct Result {
        std::size_t pairs = 0;
        double base_seconds = 0.0;
        double other_seconds = 0.0;
        Interval ratio;  ///< other over base; infinite below two pairs
    };

    /// Whether the next pass is one of the other kind.
    bool next_is_other() const { return is_second_ != other_first_; }
    bool done() const { return base_.size() >= kPairs; }

    /// Adds the time of the next pass.
    void add(double seconds);
    /// Discards the pair under way, for a disturbance: it begins again.
    void drop_pair() { is_second_ = false; }

    Result result() const;

private:
    std::vector<double> base_;
    std::vector<double> other_;
    double first_seconds_ = 0.0;  ///< of the pair under way
    bool is_second_ = false;      ///< the next pass ends a pair
    bool other_first_ = false;    ///< this pair begins with the other kind
    bool is_warm_ = false;
};

}  // namespace pl
