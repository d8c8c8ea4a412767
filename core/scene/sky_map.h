// Environment maps of functions of the direction.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/scene/description.h"

namespace pl {

/// A map twice as wide as it is high, whose texels are `radiance(direction)`, a glm::vec3, of the unit directions (glm::dvec3) in their
/// middles. Sines of two machines may differ in their last bits: `radiance` rounds coarsely enough for the same map on both.
template <class Radiance>
EnvironmentMapDescription make_sky_map(std::uint32_t height, const Radiance& radiance) {
    EnvironmentMapDescription map{
        .source = {}, .width = 2 * height, .height = height, .rotation_deg = 0.0f, .texels = {}};
    map.texels.reserve(std::size_t{map.width} * map.height);
    for (std::uint32_t row = 0; row < map.height; ++row) {
        const double colatitude = std::numbers::pi * (row + 0.5) / map.height;
        for (std::uint32_t column = 0; column < map.width; ++column) {
            const double longitude = 2.0 * std::numbers::pi * ((column + 0.5) / map.width - 0.5);
            map.texels.push_back(radiance(glm::dvec3{std::sin(colatitude) * std::sin(longitude), std::cos(colatitude),
                                                     -std::sin(colatitude) * std::cos(longitude)}));
        }
    }
    return map;
}

}  // namespace pl
