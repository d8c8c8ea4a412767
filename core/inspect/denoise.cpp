#include "core/inspect/denoise.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/parallel.h"

// Wider vectors where the machine has them; sanitizers add code that may not run before they do.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) &&             \
    !defined(__SANITIZE_THREAD__)
#define PL_WIDE_LOOP __attribute__((target_clones("default", "avx2")))
#else
#define PL_WIDE_LOOP
#endif

namespace pl {
namespace {

constexpr int kLevels = 5;  ///< the taps of a level are 2^level pixels apart
constexpr std::uint32_t kRowsAtOnce = 8;
/// Least albedo that light is divided by: images differ within a pixel.
constexpr float kLeastAlbedo = 0.1f;
/// Distance of a tap from the plane of its center, relative to the depth, at which its weight is 0.
constexpr float kPlaneTolerance = 0.03f;

/// A tap beside the center.
struct Tap {
    int dx = 0;
    int dy = 0;
    float weight = 0.0f;  ///< of the wavelet
};
constexpr float kCenterWeight = 0.25f;
constexpr std::array<Tap, 8> kTaps{{{-1, -1, 0.0625f},
                                    {0, -1, 0.125f},
                                    {1, -1, 0.0625f},
                                    {-1, 0, 0.125f},
                                    {1, 0, 0.125f},
                                    {-1, 1, 0.0625f},
                                    {0, 1, 0.125f},
                                    {1, 1, 0.0625f}}};

float positive(float value) { return value > 0.0f ? value : 0.0f; }

float luminance(float red, float green, float blue) { return 0.2126f * red + 0.7152f * green + 0.0722f * blue; }

float divisor(const FirstHits& hits, int channel, std::size_t pixel) {
    return std::max(hits.albedo[channel][pixel], kLeastAlbedo);
}

/// Calls body(row) for all rows, on several threads.
template <class Body>
void for_rows(const FirstHits& hits, Body&& body) {
    for_chunks(static_cast<std::uint32_t>(hits.height), kRowsAtOnce, usable_threads(), [&](IndexRange rows) {
        for (std::uint32_t y = rows.begin; y < rows.end; ++y) body(static_cast<int>(y));
    });
}

template <class Body>
void for_pixels(const FirstHits& hits, Body&& body) {
    const auto width = static_cast<std::size_t>(hits.width);
    for_rows(hits, [&](int y) {
        const std::size_t first = static_cast<std::size_t>(y) * width;
        for (std::size_t i = first; i < first + width; ++i) body(i);
    });
}

/// Beside another material, which samples of the pixel may have hit.
bool is_border(const FirstHits& hits, std::size_t pixel) {
    const auto width = static_cast<std::size_t>(hits.width);
    const std::size_t x = pixel % width;
    const float here = hits.material[pixel];
    return (x > 0 && hits.material[pixel - 1] != here) || (x + 1 < width && hits.material[pixel + 1] != here) ||
           (pixel >= width && hits.material[pixel - width] != here) ||
           (pixel + width < hits.count() && hits.material[pixel + width] != here);
}

/// The first pixels of a row, in all planes that decide the weight of a tap, and its light.
struct TapRow {
    const float* normal[3];
    const float* nearness;
    const float* slope[2];
    const float* material;
    const float* tone;
    const float* color[3];
};

/// Sums of light and of weights for the pixels of a row.
struct RowSums {
    std::vector<float> color[3];
    std::vector<float> weight;
};

/// Adds to the pixels [begin, end) the ones `to` behind them.
PL_WIDE_LOOP void add_tap(const TapRow& row, Tap tap, float tolerance, std::ptrdiff_t to, std::ptrdiff_t begin,
                          std::ptrdiff_t end, float* __restrict red_sum, float* __restrict green_sum,
                          float* __restrict blue_sum, float* __restrict weight_sum) {
    const auto [nx, ny, nz] = row.normal;
    const auto [red, green, blue] = row.color;
    const auto [slope_x, slope_y] = row.slope;
    const float* const nearness = row.nearness;
    const float* const material = row.material;
    const float* const tone = row.tone;
    const auto dx = static_cast<float>(tap.dx);
    const auto dy = static_cast<float>(tap.dy);
    const float per_tone = 1.0f / (tolerance * tolerance);
    const float per_plane = 1.0f / kPlaneTolerance;
    for (std::ptrdiff_t a = begin; a < end; ++a) {
        const std::ptrdiff_t b = a + to;
        const float facing = positive(nx[a] * nx[b] + ny[a] * ny[b] + nz[a] * nz[b]);
        const float squared = facing * facing;
        const float fourth = squared * squared;
        const float eighth = fourth * fourth;
        const float off = std::fabs(nearness[b] - nearness[a] - slope_x[a] * dx - slope_y[a] * dy);
        const float flat = positive(1.0f - off * per_plane / nearness[a]);
        const float contrast = tone[b] - tone[a];
        const float like = positive(1.0f - contrast * contrast * per_tone);
        const float same = material[a] == material[b] ? tap.weight : 0.0f;
        const float weight = same * eighth * eighth * flat * like;
        red_sum[a] += weight * red[b];
        green_sum[a] += weight * green[b];
        blue_sum[a] += weight * blue[b];
        weight_sum[a] += weight;
    }
}

}  // namespace

void Denoiser::resize(std::size_t count) {
    for (Light* const light : {&now_, &next_}) {
        for (Plane& plane : light->color) plane.resize(count);
        light->tone.resize(count);
    }
    material_.resize(count);
    smoothed_.resize(count);
}

void Denoiser::divide_by_albedo(std::span<const Vec3f> pixels, const FirstHits& hits) {
    for_pixels(hits, [&](std::size_t i) {
        const bool stays = !is_finite(pixels[i]);
        material_[i] = stays ? kNan : hits.material[i];  // equal to none, not even to itself
        for (int c = 0; c < 3; ++c) now_.color[c][i] = stays ? 0.0f : pixels[i][c] / divisor(hits, c, i);
    });
    // Of every seventh pixel, lamps cut: they would decide it alone.
    constexpr std::size_t kStep = 7;
    constexpr float kMost = 4.0f;
    const auto light = [&](std::size_t i) { return luminance(now_.color[0][i], now_.color[1][i], now_.color[2][i]); };
    double sum = 0.0;
    for (std::size_t i = 0; i < hits.count(); i += kStep) sum += std::min(light(i), kMost);
    mean_ = static_cast<float>(static_cast<double>(kStep) * sum / static_cast<double>(hits.count())) + 1.0e-6f;
    // A sample of a lamp or of the sky would outshine its surroundings.
    for_pixels(hits, [&](std::size_t i) {
        const float most = kMost * mean_;
        const float value = light(i);
        if (value > most && is_border(hits, i))
            for (int c = 0; c < 3; ++c) now_.color[c][i] *= most / value;
    });
    set_tones(now_, 0, hits.count());
}

void Denoiser::set_tones(Light& light, std::size_t begin, std::size_t end) const {
    for (std::size_t i = begin; i < end; ++i) {
        const float value = luminance(light.color[0][i], light.color[1][i], light.color[2][i]);
        light.tone[i] = value / (value + mean_);
    }
}

/// From now_ to next_, by taps `step` pixels apart.
void Denoiser::smooth(const FirstHits& hits, int step, float tolerance) {
    const auto width = static_cast<std::size_t>(hits.width);
    for_rows(hits, [&](int y) {
        thread_local RowSums sums;
        const std::size_t first = static_cast<std::size_t>(y) * width;
        for (int c = 0; c < 3; ++c) {
            sums.color[c].resize(width);
            for (std::size_t x = 0; x < width; ++x) sums.color[c][x] = kCenterWeight * now_.color[c][first + x];
        }
        sums.weight.assign(width, kCenterWeight);
        const auto row_of = [&](const Plane& plane) { return plane.data() + first; };
        const TapRow row{.normal = {row_of(hits.normal[0]), row_of(hits.normal[1]), row_of(hits.normal[2])},
                         .nearness = row_of(hits.nearness),
                         .slope = {row_of(hits.slope[0]), row_of(hits.slope[1])},
                         .material = row_of(material_),
                         .tone = row_of(now_.tone),
                         .color = {row_of(now_.color[0]), row_of(now_.color[1]), row_of(now_.color[2])}};
        for (const Tap& unit : kTaps) {
            const Tap tap{unit.dx * step, unit.dy * step, unit.weight};
            const int begin = std::max(0, -tap.dx);
            const int end = std::min(hits.width, hits.width - tap.dx);
            if (y + tap.dy < 0 || y + tap.dy >= hits.height || begin >= end) continue;
            add_tap(row, tap, tolerance, tap.dy * static_cast<std::ptrdiff_t>(width) + tap.dx, begin, end,
                    sums.color[0].data(), sums.color[1].data(), sums.color[2].data(), sums.weight.data());
        }
        for (float& weight : sums.weight) weight = 1.0f / weight;
        for (int c = 0; c < 3; ++c)
            for (std::size_t x = 0; x < width; ++x) next_.color[c][first + x] = sums.color[c][x] * sums.weight[x];
        set_tones(next_, first, first + width);
    });
}

std::span<const Vec3f> Denoiser::denoise(std::span<const Vec3f> pixels, const FirstHits& hits, std::uint32_t passes,
                                         const std::atomic<bool>* stop) {
    resize(hits.count());
    divide_by_albedo(pixels, hits);
    const float noise = 1.5f / std::sqrt(static_cast<float>(std::max(passes, 1u)));
    for (int level = 0; level < kLevels && (stop == nullptr || !*stop); ++level) {
        // Light whose tone differs by more has no weight: noise falls with samples, and with levels.
        smooth(hits, 1 << level, std::ldexp(2.0f, -level) + noise);
        std::swap(now_, next_);
    }
    for_pixels(hits, [&](std::size_t i) {
        for (int c = 0; c < 3; ++c)
            smoothed_[i][c] = std::isnan(material_[i]) ? pixels[i][c] : now_.color[c][i] * divisor(hits, c, i);
    });
    return smoothed_;
}

}  // namespace pl
