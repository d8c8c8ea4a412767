#include "core/measure/gain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/measure/block_means.h"
#include "core/measure/statistics.h"

namespace pl {
namespace {

template <class Number>
std::vector<double> numbers_of(std::span<const RunEnd> runs, Number number) {
    std::vector<double> values;
    for (const RunEnd& run : runs) values.push_back(number(run));
    return values;
}

/// The time from which on the mean error of `method` stays below the mean error of `base`.
std::optional<double> ahead_from(std::span<const Curve> base, std::span<const Curve> method, const CostRange& range) {
    std::optional<double> since;
    const std::vector<double> times = log_spaced(range.first, range.last, 200);
    for (auto time = times.rbegin(); time != times.rend(); ++time) {
        const auto b = error_interval_at(base, *time);
        const auto m = error_interval_at(method, *time);
        if (!b || !m || !(m->value < b->value)) break;
        since = *time;
    }
    return since;
}

/// "3.4x", with the significant digits of the ratio.
std::string times(double ratio) {
    return ratio < 9.95 ? fmt::format("{:.1f}x", ratio) : fmt::format("{:.0f}x", ratio);
}

std::string either(double ratio, const char* above, const char* below) {
    return ratio >= 1.0 ? fmt::format("{} {}", times(ratio), above) : fmt::format("{} {}", times(1.0 / ratio), below);
}

bool counts_as_equal(double ratio) { return ratio >= 1.0 / kEqualFactor && ratio <= kEqualFactor; }

bool has_bounds(const Interval& ratio) { return std::isfinite(ratio.low) && std::isfinite(ratio.high); }

std::string samples_text(double ratio, const std::string& base_name) {
    if (counts_as_equal(ratio)) return fmt::format("needs as many samples as {}", base_name);
    return fmt::format("needs {} samples than {}", either(ratio, "fewer", "more"), base_name);
}

std::string cost_text(double ratio) {
    return counts_as_equal(ratio) ? "each costs as much" : "each costs " + either(ratio, "less", "more");
}

std::string net_text(const Gain& gain) {
    const bool has_interval = gain.runs >= kFewestRuns;
    if (!has_interval && counts_as_equal(gain.net.value)) return "about as fast to the same error";
    const Verdict verdict = verdict_of(gain.net);
    if (has_interval && verdict == Verdict::NoDifference) return "no difference in the time to the same error";
    if (has_interval && verdict == Verdict::Undecided) return "undecided which is faster to the same error";
    return either(gain.net.value, "faster", "slower") + " to the same error";
}

/// Of a decided ratio as the factor that the sentence names, which is at least 1.
std::string factor_bounds_text(const Interval& net) {
    const bool inverted = verdict_of(net) == Verdict::Slower;
    const double low = inverted ? 1.0 / net.high : net.low;
    const double high = inverted ? 1.0 / net.low : net.high;
    return fmt::format("{} to {}", ratio_text(low), ratio_text(high));
}

}  // namespace

std::string ratio_text(double ratio) {
    return ratio >= 99.5 && ratio < 1e6 ? fmt::format("{:.0f}", ratio) : fmt::format("{:.2g}", ratio);
}

Gain gain_over(std::span<const RunEnd> base, std::span<const RunEnd> method, std::span<const Curve> base_curves,
               std::span<const Curve> method_curves) {
    const auto ratio = [&](auto number) {
        return ratio_interval(numbers_of(base, number), numbers_of(method, number));
    };
    Gain gain{.samples = ratio([](const RunEnd& run) { return run.error_samples(); }),
              .cost = ratio([](const RunEnd& run) { return run.seconds / run.samples; }),
              .net = ratio([](const RunEnd& run) { return run.error_seconds(); }),
              .net_trimmed = ratio([](const RunEnd& run) { return run.trimmed_error * run.seconds; }),
              .runs = std::min(base.size(), method.size()),
              .ahead_from_seconds = {}};
    std::vector<Curve> both(base_curves.begin(), base_curves.end());
    both.insert(both.end(), method_curves.begin(), method_curves.end());
    if (const auto range = common_range(both)) {
        gain.ahead_from_seconds = ahead_from(base_curves, method_curves, *range);
        gain.compared_until_seconds = range->last;
    }
    return gain;
}

Verdict verdict_of(const Interval& ratio) {
    if (!std::isfinite(ratio.value)) return Verdict::Unresolved;
    if (!has_bounds(ratio)) return Verdict::Undecided;
    if (counts_as_equal(ratio.low) && counts_as_equal(ratio.high)) return Verdict::NoDifference;
    if (ratio.contains(1.0)) return Verdict::Undecided;
    return ratio.value > 1.0 ? Verdict::Faster : Verdict::Slower;
}

std::string verdict_text(const Interval& ratio) {
    switch (verdict_of(ratio)) {
    case Verdict::Faster:
    case Verdict::Slower: return either(ratio.value, "faster", "slower");
    case Verdict::NoDifference: return "no difference";
    case Verdict::Undecided: return "undecided";
    case Verdict::Unresolved: break;
    }
    return "not resolved";
}

std::string headline(const Gain& gain, const std::string& base_name) {
    if (!std::isfinite(gain.net.value))
        return fmt::format("cannot be compared with {}: an error is below what the reference resolves", base_name);
    std::string text = fmt::format("{}, {}: {}", samples_text(gain.samples.value, base_name),
                                   cost_text(gain.cost.value), net_text(gain));
    if (gain.runs == 1)
        text += " (one run each: no interval)";
    else if (gain.runs < kFewestRuns)
        text += fmt::format(" (only {} runs: no interval)", gain.runs);
    else
        text += fmt::format(" (95 %: {})", factor_bounds_text(gain.net));
    if (gain.ahead_from_seconds)
        text += fmt::format(", ahead from {:.2g} s on", *gain.ahead_from_seconds);
    else if (gain.compared_until_seconds > 0.0)
        text += fmt::format(", not ahead at {:.2g} s", gain.compared_until_seconds);
    return text;
}

std::vector<double> log_spaced(double first, double last, int count) {
    std::vector<double> values;
    for (int i = 0; i < count; ++i)
        values.push_back(first * std::pow(last / first, static_cast<double>(i) / std::max(count - 1, 1)));
    if (!values.empty()) values.back() = last;  // rounding must not step outside
    return values;
}

std::optional<CostRange> common_range(std::span<const Curve> runs) {
    CostRange range{0.0, std::numeric_limits<double>::infinity()};
    for (const Curve& run : runs) {
        if (run.empty()) return std::nullopt;
        range.first = std::max(range.first, run.front().cost);
        range.last = std::min(range.last, run.back().cost);
    }
    if (runs.empty() || !(range.first > 0.0) || !(range.first < range.last)) return std::nullopt;
    return range;
}

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
