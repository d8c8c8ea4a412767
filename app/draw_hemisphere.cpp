#include "app/draw_hemisphere.h"

#include <fmt/format.h>

#include "app/disc_picture.h"

namespace pl {
namespace {

std::string short_vector(const Vec3f& v) {
    const Vec3f positive_zeros = v + 0.0f;
    return fmt::format("{:.3g}, {:.3g}, {:.3g}", positive_zeros.x, positive_zeros.y, positive_zeros.z);
}

void draw_layer(DiscPicture& picture, const DiscSpot& spot, const std::string& caption,
                std::span<const float> values) {
    const ValueRange range = range_of(values, {});
    picture.draw_disc(spot, caption, values, range);
    picture.draw_legend(spot, range);
}

}  // namespace

std::vector<std::string> hemisphere_lines(const VolumeInspection& volume, const CameraDescription& camera,
                                          const std::string& title) {
    const DiscFrame frame(volume.normal, camera);
    return {title,
            fmt::format("volume {}, {} directions, mean radiance {:.3g}", volume.volume, volume.side * volume.side,
                        volume.mean_radiance),
            fmt::format("position {}", short_vector(volume.position)),
            fmt::format("normal {} (cross in the center)", short_vector(volume.normal)),
            fmt::format("right {}", short_vector(frame.right())),
            fmt::format("up {} (arrow{}), camera: ring", short_vector(frame.up()),
                        frame.up_means() == DiscUp::Scene ? "" : ", up in the picture"),
            "logarithmic colors"};
}

ByteImage draw_hemisphere(const VolumeInspection& volume, const CameraDescription& camera, const std::string& title) {
    constexpr int kLine = DiscPicture::kLine;
    constexpr DiscSpot kLarge{DiscPicture::kMargin, 10 * kLine, 520};
    constexpr DiscSpot kUpper{kLarge.x + kLarge.diameter + 2 * DiscPicture::kMargin, kLarge.y, 200};
    constexpr DiscSpot kLower{kUpper.x, kLarge.y + 320, 200};
    DiscPicture picture(kUpper.x + kUpper.diameter + DiscPicture::kMargin, kLarge.y + kLarge.diameter + 4 * kLine,
                        volume, camera);
    int y = DiscPicture::kMargin;
    for (const std::string& line : hemisphere_lines(volume, camera, title)) {
        picture.text(DiscPicture::kMargin, y, line);
        y += kLine;
    }
    draw_layer(picture, kLarge, "incident radiance", volume.radiance);
    draw_layer(picture, kUpper, "probability", volume.probability);
    draw_layer(picture, kLower, "visits", std::vector<float>(volume.visits.begin(), volume.visits.end()));
    return picture.image();
}

}  // namespace pl
