#include "core/measure/tile_gain.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/measure/jackknife.h"
#include "core/measure/window_means.h"

namespace pl {
namespace {

/// Squared noise of both pictures, by groups of pixels.
struct TileNoise {
    std::array<double, kJackknifeGroups> base{};
    std::array<double, kJackknifeGroups> method{};

    void add(std::size_t group, double of_base, double of_method) {
        base[group] += of_base;
        method[group] += of_method;
    }
    /// Ratio of the noise of these groups, baseline over method.
    double ratio(GroupSet set) const {
        double above = 0.0;
        double below = 0.0;
        for (std::size_t group = 0; group < kJackknifeGroups; ++group) {
            if ((set >> group & 1u) == 0) continue;
            above += base[group];
            below += method[group];
        }
        return above / below;
    }
};

/// Both pictures as the halves of one, whose mean is the best estimate of the converged picture.
struct Together {
    std::vector<Vec3f> base;
    std::vector<Vec3f> method;
    PictureHalves halves;

    Together(const PictureHalves& a, const PictureHalves& b)
        : base(weighted_mean(a.first, a.first_weight, a.second, a.second_weight)),
          method(weighted_mean(b.first, b.first_weight, b.second, b.second_weight)),
          halves{base, method, a.first_weight + a.second_weight, b.first_weight + b.second_weight} {}
};

bool is_valid(const PictureHalves& halves, std::size_t pixel) {
    return is_finite(halves.first[pixel]) && is_finite(halves.second[pixel]);
}

double relative_noise(const PictureHalves& halves, std::size_t pixel, const Vec3d& mean) {
    const Vec3d variance = HalfShares(halves).variance(Vec3d{halves.first[pixel]}, Vec3d{halves.second[pixel]});
    return channel_mean(variance * relative_weight(mean));
}

/// Spreads each group evenly over every tile: 8 x 4 pixels have one of each.
std::size_t group_of(int x, int y) { return static_cast<std::size_t>((x & 7) + 8 * (y & 3)); }

int tile_count(int size) { return std::clamp(size / kFewestTilePixels, 1, kMostTiles); }

/// The tile that a pixel belongs to; the inverse of TileGains::edge().
int tile_of(int pixel, int count, int size) { return (count * (pixel + 1) - 1) / size; }

std::vector<TileNoise> noise_by_tile(const PictureHalves& base, const PictureHalves& method, int width, int height) {
    const int columns = tile_count(width);
    std::vector<TileNoise> tiles(static_cast<std::size_t>(columns * tile_count(height)));
    const Together together(base, method);
    WindowMeans around(together.halves, static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height));
    for (int y = 0; y < height; ++y) {
        around.enter_row(static_cast<std::uint32_t>(y));
        const int row = tile_of(y, tile_count(height), height);
        for (int x = 0; x < width; ++x) {
            const Vec3d mean = around.mean_at(static_cast<std::uint32_t>(x));
            const std::size_t pixel = static_cast<std::size_t>(y * width + x);
            if (!is_valid(base, pixel) || !is_valid(method, pixel)) continue;
            tiles[static_cast<std::size_t>(row * columns + tile_of(x, columns, width))].add(
                group_of(x, y), relative_noise(base, pixel, mean), relative_noise(method, pixel, mean));
        }
    }
    return tiles;
}

Interval gain_in(const TileNoise& noise, double seconds_ratio) {
    return jackknife_ratio([&](GroupSet set) { return seconds_ratio * noise.ratio(set); });
}

}  // namespace

TileGains tile_gains(const TimedHalves& base, const TimedHalves& method, int width) {
    require_full_rows(base.halves.first.size(), width);
    require_same_sizes({base.halves.first, base.halves.second, method.halves.first, method.halves.second});
    const int height = static_cast<int>(base.halves.first.size()) / width;
    TileGains gains{.columns = tile_count(width), .rows = tile_count(height), .tiles = {}, .picture = {}};
    const double seconds_ratio = base.seconds / method.seconds;
    TileNoise all;
    for (const TileNoise& tile : noise_by_tile(base.halves, method.halves, width, height)) {
        gains.tiles.push_back(gain_in(tile, seconds_ratio));
        for (std::size_t group = 0; group < kJackknifeGroups; ++group)
            all.add(group, tile.base[group], tile.method[group]);
    }
    gains.picture = gain_in(all, seconds_ratio);
    return gains;
}

std::string_view mark_name(Verdict verdict) {
    switch (verdict) {
    case Verdict::Faster: return "gains";
    case Verdict::Slower: return "loses";
    case Verdict::NoDifference: return "no difference";
    case Verdict::Undecided:
    case Verdict::Unresolved: break;
    }
    return "undecided";
}

std::string mark_text(const Interval& net) {
    const Verdict verdict = verdict_of(net);
    const std::string_view name = mark_name(verdict);
    if (verdict == Verdict::Faster)
        return fmt::format("{} {}x ({} to {})", name, ratio_text(net.value), ratio_text(net.low),
                           ratio_text(net.high));
    if (verdict == Verdict::Slower)
        return fmt::format("{} {}x ({} to {})", name, ratio_text(1.0 / net.value), ratio_text(1.0 / net.high),
                           ratio_text(1.0 / net.low));
    return fmt::format("{} ({} to {})", name, ratio_text(net.low), ratio_text(net.high));
}

std::uint32_t mark_color(Verdict verdict) {
    switch (verdict) {
    case Verdict::Faster: return 0xff5cd66fu;
    case Verdict::Slower: return 0xffff5f57u;
    case Verdict::NoDifference: return 0xffe8e8e8u;
    case Verdict::Undecided:
    case Verdict::Unresolved: break;
    }
    return 0xff8a8f98u;
}

}  // namespace pl
