#include "ui/model/luminance_histogram.h"

#include <algorithm>
#include <cmath>

#include "core/kernel/film/tonemap.h"

namespace pl::ui {
namespace {

constexpr float kBinsPerStop =
    static_cast<float>(LuminanceHistogram::kBins) / (LuminanceHistogram::kHigh - LuminanceHistogram::kLow);

}  // namespace

LuminanceHistogram make_histogram(std::span<const Vec3f> pixels, std::size_t most) {
    LuminanceHistogram histogram;
    // An odd step, so that it visits every column of pictures with an even width.
    const std::size_t step = pixels.size() > most ? (pixels.size() + most - 1) / most | 1u : 1;
    for (std::size_t i = 0; i < pixels.size(); i += step) {
        const float light = luminance(pixels[i]);
        ++histogram.pixels;
        if (!std::isfinite(light)) {
            ++histogram.invalid;
            continue;
        }
        const float at = light > 0.0f ? (std::log2(light) - LuminanceHistogram::kLow) * kBinsPerStop : -1.0f;
        if (at < 0.0f)
            ++histogram.dark;
        else if (at >= static_cast<float>(LuminanceHistogram::kBins))
            ++histogram.bright;
        else
            ++histogram.counts[static_cast<std::size_t>(at)];
    }
    return histogram;
}

std::optional<float> LuminanceHistogram::percentile(float share) const {
    if (counted() == 0) return std::nullopt;
    const float wanted = std::clamp(share, 0.0f, 1.0f) * static_cast<float>(counted());
    float below = 0.0f;
    float last = kLow;
    for (std::size_t bin = 0; bin < counts.size(); ++bin) {
        const auto inside = static_cast<float>(counts[bin]);
        if (inside == 0.0f) continue;
        if (below + inside >= wanted)
            return kLow + (static_cast<float>(bin) + (wanted - below) / inside) / kBinsPerStop;
        below += inside;
        last = kLow + static_cast<float>(bin + 1) / kBinsPerStop;
    }
    return last;
}

std::optional<float> LuminanceHistogram::mean(float low_share, float high_share) const {
    if (counted() == 0) return std::nullopt;
    const float first = low_share * static_cast<float>(counted());
    const float last = high_share * static_cast<float>(counted());
    float below = 0.0f;
    double sum = 0.0;
    double weight = 0.0;
    for (std::size_t bin = 0; bin < counts.size(); ++bin) {
        const auto inside = static_cast<float>(counts[bin]);
        const float part = std::min(below + inside, last) - std::max(below, first);
        below += inside;
        if (!(part > 0.0f)) continue;
        sum += static_cast<double>(part) * (kLow + (static_cast<double>(bin) + 0.5) / kBinsPerStop);
        weight += static_cast<double>(part);
    }
    return weight > 0.0 ? std::optional(static_cast<float>(sum / weight)) : percentile(0.5f);
}

std::optional<float> automatic_exposure(const LuminanceHistogram& histogram) {
    constexpr float kGray = 0.18f;
    const std::optional<float> mean = histogram.mean(0.05f, 0.95f);
    return mean ? std::optional(std::log2(kGray) - *mean) : std::nullopt;
}

}  // namespace pl::ui
