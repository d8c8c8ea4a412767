// The drawn hemisphere of a volume: each cell at its directions.
#include "app/disc_picture.h"

#include "tests/support/catch.hpp"

namespace pl {

TEST_CASE("the drawn disc shows each cell at its directions") {
    VolumeInspection volume;
    volume.normal = {0, 0, 1};
    volume.side = 4;
    volume.radiance.assign(16, 0.0f);
    volume.probability.assign(16, 1.0f / 16.0f);
    volume.visits.assign(16, 1);
    volume.radiance[15] = 1.0f;  // highest row and column: towards +x, +y
    // The camera in front of the surface, upright: the axes of the disc are x and y, as are the axes of the cells.
    const ByteImage image = draw_hemisphere(volume, {.eye = {0, 0, 5}}, "test");
    const Rgb bright = map_color_of(1.0f);
    const auto color_at = [&](int x, int y) {
        const std::size_t i = 3 * static_cast<std::size_t>(y * image.width + x);
        return Rgb{image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]};
    };
    // The large disc: upper left corner (24, 180), diameter 520.
    const int center_x = 24 + 260, center_y = 180 + 260, off = 170;
    CHECK(color_at(center_x + off, center_y - off) == bright);
    CHECK(color_at(center_x - off, center_y - off) == map_color_of(0.0f));
    CHECK(color_at(center_x + off, center_y + off) == map_color_of(0.0f));
}

}  // namespace pl
