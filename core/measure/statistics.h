// Confidence intervals from a few repeated runs. Errors are skewed, so their logarithms are averaged.
#pragma once

#include <span>

namespace pl {

/// Quantile of Student's t with `freedom` degrees (any positive number) at a probability in (0, 1).
double student_quantile(double probability, double freedom);

/// An estimate with bounds that hold the true value in `confidence` of all experiments.
struct Interval {
    double value = 0.0;
    double low = 0.0;
    double high = 0.0;

    bool contains(double truth) const { return low <= truth && truth <= high; }
};

inline constexpr double kConfidence = 0.95;

/// Below kFewestRuns an interval is too wide to be shown; below kGoodRuns it is called rough.
inline constexpr std::size_t kFewestRuns = 5;
inline constexpr std::size_t kGoodRuns = 10;

/// Mean of values with Student's interval, which is infinite for fewer than two values.
Interval mean_interval(std::span<const double> values);

/// Geometric mean of positive values, with the interval of the mean logarithm. All NaN if a value is not positive:
/// leaving it out would bias the mean.
Interval geometric_interval(std::span<const double> values);

/// Ratio of the geometric means of two independent sets, by Welch's test on logarithms.   [Welch 1947]
Interval ratio_interval(std::span<const double> numerator, std::span<const double> denominator);

/// Slope of a least-squares line through points. NaN below two different x.
double line_slope(std::span<const double> x, std::span<const double> y);

/// Median of at least one value; NaN for none.
double median_of(std::span<const double> values);

}  // namespace pl
