// Pictures kept for later, in half floats: half the memory, three digits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/measure/metrics.h"

namespace pl {

/// Linear values, row 0 on top.
struct HalfPicture {
    int width = 0;
    int height = 0;
    std::vector<std::uint16_t> rgb;

    std::size_t bytes() const { return rgb.size() * sizeof(std::uint16_t); }
};

HalfPicture half_picture(int width, int height, Pixels pixels);
std::vector<Vec3f> pixels_of(const HalfPicture& picture);

}  // namespace pl
