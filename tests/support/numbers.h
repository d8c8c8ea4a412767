// Numbers that tests of several folders share.
#pragma once

#include <numbers>

namespace pl::test {

/// The largest number below one.
inline constexpr float kAlmostOne = 1.0f - 0x1p-24f;
/// Angles in radians.
inline constexpr double kHalfTurn = std::numbers::pi;
inline constexpr double kTurn = 2.0 * std::numbers::pi;

}  // namespace pl::test
