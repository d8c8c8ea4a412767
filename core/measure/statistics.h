// Confidence intervals from a few repeated runs. Errors are skewed, so their logarithms are averaged.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

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

/// "1.5 (1.2 to 1.8)".
std::string interval_text(const Interval& interval);

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

// Intervals of figures that are not means, from samples dealt to 32 groups that are independent of each other and alike.

/// Samples are dealt to this many groups, in turn or at random.
inline constexpr std::size_t kJackknifeGroups = 32;

/// A set of groups: bit g for group g.
using GroupSet = std::uint32_t;
inline constexpr GroupSet kAllGroups = 0xffffffffu;
inline constexpr GroupSet kEvenGroups = 0x55555555u;
inline constexpr GroupSet kOddGroups = ~kEvenGroups;

using GroupFigure = std::function<double(GroupSet)>;

/// A figure of the mean over groups without the part of its bias that falls as 1 / paths: twice the figure of all, less the mean of
/// the figures of the two halves.   [Quenouille 1956]
double without_bias(const GroupFigure& figure, GroupSet groups);

/// The figure of all groups, with Student's interval from the figures that leave out one pair of neighboring groups (delete-one
/// jackknife, 16 pairs, each with a group of both halves).   [Tukey 1958]
Interval jackknife_interval(const GroupFigure& figure);

/// Of a positive figure: the interval of its logarithm. [0, inf) around the figure where it is not positive and finite in every set.
Interval jackknife_ratio(const GroupFigure& figure);

}  // namespace pl
