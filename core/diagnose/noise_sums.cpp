#include "core/diagnose/noise_sums.h"

#include <algorithm>

namespace pl::diagnose {
namespace {

constexpr std::size_t kFirstBounce = kFoundByCount;
constexpr std::size_t kFirstLight = kFoundByCount + kBounceClasses;

/// A run of the jackknife is a pair of groups.
constexpr std::size_t kRuns = kJackknifeGroups / 2;

}  // namespace

NoiseSums::Sums& NoiseSums::Sums::operator+=(const Sums& other) {
    paths += other.paths;
    total += other.total;
    square += other.square;
    seconds += other.seconds;
    for (std::size_t i = 0; i < kClasses; ++i) {
        parts[i] += other.parts[i];
        products[i] += other.products[i];
    }
    return *this;
}

void NoiseSums::add(std::size_t group, std::span<const Contribution> path) {
    Sums& sums = groups_[group];
    std::array<double, kClasses> parts{};
    double total = 0.0;
    for (const Contribution& contribution : path) {
        const std::size_t bounces = std::min<std::size_t>(contribution.bounces, kBounceClasses - 1);
        parts[static_cast<std::size_t>(contribution.found_by)] += contribution.light;
        parts[kFirstBounce + bounces] += contribution.light;
        parts[kFirstLight + (contribution.is_distant ? 1 : 0)] += contribution.light;
        total += contribution.light;
    }
    sums.paths += 1.0;
    sums.total += total;
    sums.square += total * total;
    for (std::size_t i = 0; i < kClasses; ++i) {
        sums.parts[i] += parts[i];
        sums.products[i] += parts[i] * total;
    }
}

bool NoiseSums::has_all_groups() const {
    return std::ranges::all_of(groups_, [](const Sums& sums) { return sums.paths > 0.0; });
}

NoiseSums::Sums NoiseSums::sum(GroupSet set) const {
    Sums result;
    for (std::size_t group = 0; group < kJackknifeGroups; ++group)
        if ((set >> group & 1u) != 0) result += groups_[group];
    return result;
}

double NoiseSums::mean(GroupSet set) const {
    const Sums sums = sum(set);
    return sums.total / sums.paths;
}

double NoiseSums::variance(GroupSet set) const {
    const Sums sums = sum(set);
    const double mean = sums.total / sums.paths;
    return std::max(sums.square / sums.paths - mean * mean, 0.0) * sums.paths / (sums.paths - 1.0);
}

double NoiseSums::seconds_per_path(GroupSet set) const {
    const Sums sums = sum(set);
    return sums.seconds / sums.paths;
}

Interval NoiseSums::share(std::size_t part) const {
    return jackknife_interval([&](GroupSet set) {
        const Sums sums = sum(set);
        const double mean = sums.total / sums.paths;
        return (sums.products[part] / sums.paths - mean * sums.parts[part] / sums.paths) /
               (sums.square / sums.paths - mean * mean);
    });
}

PixelEstimate NoiseSums::estimate() const {
    const Sums all = sum(kAllGroups);
    PixelEstimate result{.paths = static_cast<std::uint64_t>(all.paths),
                         .mean = jackknife_interval([&](GroupSet set) { return mean(set); }),
                         .variance = jackknife_interval([&](GroupSet set) { return variance(set); }),
                         .seconds_per_path = seconds_per_path(kAllGroups)};
    if (!(result.variance.value > 0.0)) return result;
    NoiseShares& shares = result.shares.emplace();
    for (std::size_t i = 0; i < kFoundByCount; ++i) shares.found_by[i] = share(i);
    for (std::size_t i = 0; i < kBounceClasses; ++i) shares.bounces[i] = share(kFirstBounce + i);
    for (std::size_t i = 0; i < shares.lights.size(); ++i) shares.lights[i] = share(kFirstLight + i);
    return result;
}

std::optional<Gain> pixel_gain(const NoiseSums& base, const NoiseSums& method) {
    if (!(base.variance(kAllGroups) > 0.0) || !(method.variance(kAllGroups) > 0.0)) return std::nullopt;
    const auto samples = [&](GroupSet set) { return base.variance(set) / method.variance(set); };
    const auto cost = [&](GroupSet set) { return base.seconds_per_path(set) / method.seconds_per_path(set); };
    return Gain{.samples = jackknife_ratio(samples),
                .cost = jackknife_ratio(cost),
                .net = jackknife_ratio([&](GroupSet set) { return samples(set) * cost(set); }),
                .runs = kRuns,
                .ahead_from_seconds = std::nullopt};
}

}  // namespace pl::diagnose
