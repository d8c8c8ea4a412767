#include "core/measure/half_picture.h"

#include "core/kernel/base/half.h"

namespace pl {

HalfPicture half_picture(int width, int height, Pixels pixels) {
    HalfPicture picture{.width = width, .height = height, .rgb = {}};
    picture.rgb.reserve(3 * pixels.size());
    for (const Vec3f& pixel : pixels)
        for (const float value : {pixel.x, pixel.y, pixel.z}) picture.rgb.push_back(to_half(value));
    return picture;
}

std::vector<Vec3f> pixels_of(const HalfPicture& picture) {
    std::vector<Vec3f> pixels(picture.rgb.size() / 3);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = {from_half(picture.rgb[3 * i]), from_half(picture.rgb[3 * i + 1]),
                     from_half(picture.rgb[3 * i + 2])};
    return pixels;
}

}  // namespace pl
