#include "app/disc_picture.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/kernel/film/heat_color.h"
#include "core/kernel/guiding/direction_cells.h"

namespace pl {
namespace {

constexpr int kBarHeight = 12;
constexpr Rgb kShadow{0, 0, 0};

std::string three_digits(float value) { return fmt::format("{:.3g}", value); }

}  // namespace

Rgb map_color_of(float position) {
    const ByteColor color = heat_color(position);
    return {color.r, color.g, color.b};
}

DiscPicture::DiscPicture(int width, int height, const VolumeInspection& volume, const CameraDescription& camera)
    : canvas_(width, height, kBackground), side_(volume.side), frame_(volume.normal, camera),
      to_camera_(glm::normalize(camera.eye - volume.position)) {}

void DiscPicture::draw_disc(const DiscSpot& spot, const std::string& caption, std::span<const float> values,
                            const ValueRange& range) {
    const DirectionCells cells{.side = side_};
    const float radius = 0.5f * static_cast<float>(spot.diameter);
    for (int row = 0; row < spot.diameter; ++row)
        for (int column = 0; column < spot.diameter; ++column) {
            const Vec2f point{(static_cast<float>(column) + 0.5f) / radius - 1.0f,
                              1.0f - (static_cast<float>(row) + 0.5f) / radius};
            if (glm::dot(point, point) > 1.0f) continue;
            const int cell = cells.cell_of(disk_to_square(frame_.to_cells(point)));
            canvas_.put(spot.x + column, spot.y + row,
                        map_color_of(range.position(values[static_cast<std::size_t>(cell)])));
        }
    text(spot.x, spot.y - kLine - 10, caption);
    draw_marks(spot);
}

void DiscPicture::draw_marks(const DiscSpot& spot) {
    const int middle_x = spot.x + spot.diameter / 2;
    const int middle_y = spot.y + spot.diameter / 2;
    for (int i = -5; i <= 5; ++i) {
        canvas_.fill(middle_x + i, middle_y, 1, 2, kInk);
        canvas_.fill(middle_x, middle_y + i, 2, 1, kInk);
    }
    for (int i = 0; i < 6; ++i) canvas_.fill(middle_x - i, spot.y - 8 + i, 2 * i + 1, 1, kInk);
    const std::optional<Vec2f> camera = frame_.point_of(to_camera_);
    if (!camera) return;
    const Vec2f center =
        Vec2f(middle_x, middle_y) + 0.5f * static_cast<float>(spot.diameter) * Vec2f(camera->x, -camera->y);
    for (const auto& [radius, color] : {std::pair{7.0f, kShadow}, std::pair{6.0f, kInk}})
        for (int i = 0; i < 48; ++i) {
            const float angle = 2.0f * kPi * static_cast<float>(i) / 48.0f;
            canvas_.put(static_cast<int>(std::lround(center.x + radius * std::cos(angle))),
                        static_cast<int>(std::lround(center.y + radius * std::sin(angle))), color);
        }
}

void DiscPicture::draw_legend(const DiscSpot& spot, const ValueRange& range) {
    const int y = spot.y + spot.diameter + 10;
    for (int column = 0; column < spot.diameter; ++column)
        canvas_.fill(spot.x + column, y, 1, kBarHeight,
                     map_color_of(static_cast<float>(column) / static_cast<float>(spot.diameter - 1)));
    const int below = y + kBarHeight + 6;
    const std::string low = three_digits(range.low);
    const std::string middle = three_digits(range.value_at(0.5f));
    const std::string high = three_digits(range.high);
    text(spot.x, below, low);
    if (Canvas::text_width(low + " ") + Canvas::text_width(middle) / 2 < spot.diameter / 2 &&
        Canvas::text_width(middle) / 2 + Canvas::text_width(" " + high) < spot.diameter / 2)
        text(spot.x + (spot.diameter - Canvas::text_width(middle)) / 2, below, middle);
    text(spot.x + spot.diameter - Canvas::text_width(high), below, high);
}

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
                        frame.up_is_scene() ? "" : ", up in the picture"),
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

namespace {

constexpr int kDiameter = 380;

struct Layer {
    std::string caption;
    std::vector<float> values;
};

std::vector<float> relative_to_cosine(const std::vector<float>& shares) {
    std::vector<float> density(shares);
    for (float& d : density) d *= static_cast<float>(shares.size());
    return density;
}

/// Two discs side by side, whose values share one range.
void draw_pair(DiscPicture& picture, int y, const Layer& left, const Layer& right) {
    std::vector<float> both(left.values);
    both.insert(both.end(), right.values.begin(), right.values.end());
    const ValueRange range = range_of(both, {});
    int x = DiscPicture::kMargin;
    for (const Layer* layer : {&left, &right}) {
        const DiscSpot spot{x, y, kDiameter};
        picture.draw_disc(spot, layer->caption, layer->values, range);
        picture.draw_legend(spot, range);
        x += kDiameter + 2 * DiscPicture::kMargin;
    }
}

std::string interval_text(const Interval& interval) {
    return fmt::format("{:.3g} ({:.3g} to {:.3g})", interval.value, interval.low, interval.high);
}

}  // namespace

std::vector<std::string> truth_lines(const LightReport& truth) {
    const GuidingFigures& figures = truth.figures;
    std::vector<std::string> lines{
        fmt::format("truth: {} paths per cell, incident light: {}", truth.paths_per_cell, name_of(truth.target)),
        fmt::format("KL divergence of the table {} nats", interval_text(figures.table)),
        fmt::format("KL divergence of the mixture {} nats", interval_text(figures.mixture)),
        figures.variance_factor
            ? fmt::format("variance by the mixture / by BSDF sampling {}", interval_text(*figures.variance_factor))
            : "BSDF sampling has no variance here"};
    if (truth.invalid_paths > 0) lines.push_back(fmt::format("invalid paths: {}", truth.invalid_paths));
    return lines;
}

ByteImage draw_truth(const VolumeInspection& volume, const LightReport& truth, const CameraDescription& camera,
                     const std::string& title) {
    constexpr int kLine = DiscPicture::kLine;
    std::vector<std::string> lines = hemisphere_lines(volume, camera, title);
    for (std::string& line : truth_lines(truth)) lines.push_back(std::move(line));
    const int upper = DiscPicture::kMargin + (static_cast<int>(lines.size()) + 3) * kLine;
    const int lower = upper + kDiameter + DiscPicture::kLegendHeight + 2 * kLine;
    DiscPicture picture(2 * kDiameter + 4 * DiscPicture::kMargin, lower + kDiameter + DiscPicture::kLegendHeight,
                        volume, camera);
    int y = DiscPicture::kMargin;
    for (const std::string& line : lines) {
        picture.text(DiscPicture::kMargin, y, line);
        y += kLine;
    }
    draw_pair(picture, upper, {"learned radiance", volume.radiance},
              {fmt::format("true radiance, {}", name_of(truth.target)), truth.light.target});
    draw_pair(picture, lower, {"density of guided paths", relative_to_cosine(truth.mixture_shares)},
              {"product with the BSDF", relative_to_cosine(truth.product_shares)});
    return picture.image();
}

}  // namespace pl
