// Intervals of figures that are not means, from samples dealt to 32 groups that are independent of each other and alike.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "core/measure/statistics.h"

namespace pl {

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
