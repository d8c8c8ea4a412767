// Form factors from a point to rectangles: irradiance over pi times the radiance of the rectangle.
#pragma once

#include <cmath>

namespace pl {

/// To a rectangle of sides a and b in a parallel plane at distance c, with a corner right above the point. Odd in a
/// and in b, so that rectangles at other positions are sums over their corners.   [Howell, Catalog of Radiation
/// Transfer Configuration Factors, B-3]
inline double parallel_corner_factor(double a, double b, double c) {
    constexpr double kTwoPi = 6.283185307179586;
    const double x = a / c;
    const double y = b / c;
    return (x / std::hypot(1.0, x) * std::atan(y / std::hypot(1.0, x)) +
            y / std::hypot(1.0, y) * std::atan(x / std::hypot(1.0, y))) /
           kTwoPi;
}

/// To a perpendicular rectangle whose lower side lies in the point's plane, at distance c, and starts right in front
/// of the point: b wide, a high. Odd in b.   [Howell, B-4]
inline double perpendicular_corner_factor(double a, double b, double c) {
    constexpr double kTwoPi = 6.283185307179586;
    const double x = a / b;
    const double y = c / b;
    const double diagonal = std::copysign(std::hypot(x, y), b);
    return (std::atan(1.0 / y) - y / diagonal * std::atan(1.0 / diagonal)) / kTwoPi;
}

}  // namespace pl
