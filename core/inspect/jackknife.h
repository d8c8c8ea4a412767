// Intervals of figures that are not means, from the groups of an IncidentLight.
#pragma once

#include <cstdint>
#include <functional>

#include "core/measure/statistics.h"

namespace pl {

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

}  // namespace pl
