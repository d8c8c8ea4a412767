// A logarithmic axis: positions of values, and ticks. Plots on screen and in files share it.
#pragma once

#include <string>
#include <vector>

namespace pl {

struct AxisTick {
    double value = 0.0;
    std::string label;  ///< empty for minor ticks
};

class LogAxis {
public:
    /// Covers [low, high] with a margin, so that no line runs along the frame. Bounds that are not positive, not
    /// finite or in the wrong order give an axis of one decade around 1.
    LogAxis(double low, double high);
    /// Covers [low, high] without a margin; invalid bounds as above.
    static LogAxis exactly(double low, double high);

    double low() const { return low_; }
    double high() const { return high_; }
    /// 0 at low(), 1 at high(), extended beyond. `value` must be positive.
    double position(double value) const;
    /// The value at a position: inverse of position().
    double value_at(double position) const;

    /// Labeled ticks at 1, 2 and 5 times powers of ten if these are at most `most_labels`, else at 1 only, or at
    /// every second, third... power; the other digits are minor ticks.
    std::vector<AxisTick> ticks(int most_labels) const;

private:
    LogAxis(double low, double high, double margin);

    double low_;
    double high_;
};

/// "0.01", "20", "5e-07": short, and read back as the same tick.
std::string tick_label(double value);

}  // namespace pl
