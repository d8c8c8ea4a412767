// Small scenes whose radiance is known in closed form, for the self test. Built in memory, without files.
#pragma once

#include <cmath>

#include "core/scene/description.h"

namespace pl {

// Form factors from a point to rectangles: irradiance over pi times the radiance of the rectangle.

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

/// A closed box that emits and reflects uniformly: radiance emission / (1 - albedo) at every point in every
/// direction.
SceneDescription furnace(glm::vec3 emission, float albedo);

/// A block without absorption under a uniform sky of radiance 1: it is invisible.
SceneDescription lossless_block(const MaterialDescription& material);

/// A gray floor under, or beside, a black rectangular lamp of radiance 1; the camera sees one point of the floor.
struct LampScene {
    SceneDescription scene;
    double floor_radiance = 0.0;  ///< at that point
};

/// The lamp is parallel to the floor.   [Howell, Catalog of Radiation Transfer Configuration Factors, B-3]
LampScene lamp_over_floor();
/// The lamp is perpendicular to the floor and touches it.   [Howell, B-4]
LampScene lamp_beside_floor();
/// A lamp so small and distant that irradiance follows the inverse-square law; relative error below 1e-6.
LampScene tiny_lamp();

/// A floor of this albedo under a sky of radiance a + b y; its exitant radiance is albedo (a + 2 b / 3).
SceneDescription floor_under_linear_sky(float albedo, float a, float b);

/// The unit cube with albedo 0.5 whose ceiling emits 1; the camera sees the middle of the floor.
SceneDescription cube_under_ceiling();
/// Exitant radiance there, and the error bound of that number.   [solved by collocation, 6 x 64 x 64 patches]
inline constexpr double kCubeFloorRadiance = 0.19760;
inline constexpr double kCubeFloorError = 1.0e-5;

/// Two plates that face each other, emitting 1 and 0.25 with albedos 0.7 and 0.4, between four perfect mirrors, which
/// make them infinite.
SceneDescription plates_between_mirrors();
/// Exitant radiance of the first plate: (e1 + rho1 e2) / (1 - rho1 rho2).
inline constexpr double kPlateRadiance = (1.0 + 0.7 * 0.25) / (1.0 - 0.7 * 0.4);

}  // namespace pl
