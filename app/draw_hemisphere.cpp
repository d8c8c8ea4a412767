#include "app/draw_hemisphere.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "core/kernel/base/frame.h"
#include "core/kernel/guiding/direction_cells.h"

namespace pl {
namespace {

constexpr Rgb kBackground{24, 24, 28};
constexpr Rgb kInk{230, 230, 230};
constexpr int kTextScale = 2;
constexpr int kLine = Canvas::kLineHeight * kTextScale;
constexpr int kMargin = 24;
constexpr int kBarHeight = 12;

/// Values of the cells, and their captions.
struct Layer {
    std::string label;
    std::vector<float> values;
};

/// Place of a disc.
struct Place {
    int x;  ///< left edge
    int y;  ///< top edge
    int diameter;
};

std::string short_number(double value) { return fmt::format("{:.4g}", value); }

std::string short_vector(const Vec3f& v) {
    const Vec3f positive_zeros = v + 0.0f;
    return fmt::format("{:.3g}, {:.3g}, {:.3g}", positive_zeros.x, positive_zeros.y, positive_zeros.z);
}

/// Colors go by the square root: most cells of a hemisphere with a light in it have small values.
Rgb value_color(float value, float largest) {
    return share_color(largest > 0.0f ? std::sqrt(std::max(value, 0.0f) / largest) : 0.0f);
}

void draw_disc(Canvas& canvas, const Place& place, const DirectionCells& cells, const Layer& layer, float largest) {
    const float radius = 0.5f * static_cast<float>(place.diameter);
    for (int row = 0; row < place.diameter; ++row)
        for (int column = 0; column < place.diameter; ++column) {
            const Vec2f point{(static_cast<float>(column) + 0.5f) / radius - 1.0f,
                              1.0f - (static_cast<float>(row) + 0.5f) / radius};
            if (glm::dot(point, point) > 1.0f) continue;
            const int cell = cells.cell_of(disk_to_square(point));
            canvas.put(place.x + column, place.y + row,
                       value_color(layer.values[static_cast<std::size_t>(cell)], largest));
        }
}

/// A bar of all colors below the disc: 0 at the left, the largest value at the right, a quarter of it in the middle.
void draw_legend(Canvas& canvas, const Place& place, float largest) {
    const int y = place.y + place.diameter + 10;
    for (int column = 0; column < place.diameter; ++column)
        canvas.fill(place.x + column, y, 1, kBarHeight,
                    share_color(static_cast<float>(column) / static_cast<float>(place.diameter - 1)));
    const int below = y + kBarHeight + 6;
    const auto width = [](const std::string& text) {
        return static_cast<int>(text.size()) * Canvas::kAdvance * kTextScale;
    };
    const std::string middle = short_number(0.25 * largest);
    const std::string end = short_number(largest);
    canvas.text(place.x, below, "0", kInk, kTextScale);
    if (width("0 ") + width(middle) / 2 < place.diameter / 2 &&
        width(middle) / 2 + width(" " + end) < place.diameter / 2)
        canvas.text(place.x + (place.diameter - width(middle)) / 2, below, middle, kInk, kTextScale);
    canvas.text(place.x + place.diameter - width(end), below, end, kInk, kTextScale);
}

void draw_layer(Canvas& canvas, const Place& place, const DirectionCells& cells, const Layer& layer) {
    const float largest = *std::max_element(layer.values.begin(), layer.values.end());
    canvas.text(place.x, place.y - kLine - 4, layer.label, kInk, kTextScale);
    draw_disc(canvas, place, cells, layer, largest);
    draw_legend(canvas, place, largest);
}

}  // namespace

Rgb share_color(float share) {
    // Anchors of the viridis map: brightness rises evenly, also without color.
    constexpr std::array<Rgb, 9> kAnchors{Rgb{68, 1, 84},    Rgb{71, 44, 122},  Rgb{59, 81, 139},
                                          Rgb{44, 113, 142}, Rgb{33, 144, 141}, Rgb{39, 173, 129},
                                          Rgb{92, 200, 99},  Rgb{170, 220, 50}, Rgb{253, 231, 37}};
    const float at = std::clamp(share, 0.0f, 1.0f) * static_cast<float>(kAnchors.size() - 1);
    const auto first = std::min(static_cast<std::size_t>(at), kAnchors.size() - 2);
    const float t = at - static_cast<float>(first);
    Rgb color{};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const auto from = static_cast<float>(kAnchors[first][channel]);
        const auto to = static_cast<float>(kAnchors[first + 1][channel]);
        color[channel] = static_cast<std::uint8_t>(std::lround(from + t * (to - from)));
    }
    return color;
}

ByteImage draw_hemisphere(const VolumeInspection& volume, const std::string& title) {
    constexpr Place kLarge{kMargin, 10 * kLine, 520};
    constexpr Place kUpper{kLarge.x + kLarge.diameter + 2 * kMargin, kLarge.y, 200};
    constexpr Place kLower{kUpper.x, kLarge.y + 320, 200};
    Canvas canvas(kUpper.x + kUpper.diameter + kMargin, kLarge.y + kLarge.diameter + 4 * kLine, kBackground);

    const Frame frame = make_frame(volume.normal);
    const std::string lines[] = {title,
                                 fmt::format("volume {}, {} directions, mean radiance {}", volume.volume,
                                             volume.side * volume.side, short_number(volume.mean_radiance)),
                                 fmt::format("position {}", short_vector(volume.position)),
                                 fmt::format("normal {} (center)", short_vector(volume.normal)),
                                 fmt::format("right {}", short_vector(frame.x)),
                                 fmt::format("up {}", short_vector(frame.y)),
                                 "colors by the square root of the value"};
    int y = kMargin;
    for (const std::string& line : lines) {
        canvas.text(kMargin, y, line, kInk, kTextScale);
        y += kLine;
    }
    const DirectionCells cells{.side = volume.side};
    draw_layer(canvas, kLarge, cells, {"incident radiance", volume.radiance});
    draw_layer(canvas, kUpper, cells, {"probability", volume.probability});
    draw_layer(canvas, kLower, cells, {"visits", {volume.visits.begin(), volume.visits.end()}});
    return canvas.image();
}

}  // namespace pl
