// A logarithmic axis: where values lie on it, and which ticks it gets. Plots on screen and in files share it.
#pragma once

#include <string>
#include <vector>

namespace pl {

struct AxisTick {
    double value = 0.0;
    std::string label;  ///< empty for lines of the minor grid
};

class LogAxis {
public:
    /// Covers [low, high] and a little more, so that no line runs along the frame. Bounds that are no positive numbers,
    /// or in the wrong order, give an axis of one decade around 1.
    LogAxis(double low, double high);
    /// Covers [low, high] and nothing more, with the same answer to nonsense.
    static LogAxis exactly(double low, double high);

    double low() const { return low_; }
    double high() const { return high_; }
    /// 0 at low(), 1 at high(); outside of that beyond. `value` must be positive.
    double position(double value) const;
    /// The value at a position: inverse of position().
    double value_at(double position) const;

    /// At 1, 2 and 5 times powers of ten with labels as long as that leaves at most `most_labels`, else at 1 only, or at
    /// every second, third... power; the other digits are minor.
    std::vector<AxisTick> ticks(int most_labels) const;

private:
    LogAxis(double low, double high, double margin);

    double low_;
    double high_;
};

/// "0.01", "20", "5e-07": short, and read back as the same tick.
std::string tick_label(double value);

}  // namespace pl
