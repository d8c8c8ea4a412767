#include "app/draw_truth.h"

#include <fmt/format.h>

#include "app/disc_picture.h"
#include "app/draw_hemisphere.h"

namespace pl {
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
