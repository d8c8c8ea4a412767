#include "core/diagnose/pixel_noise.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/timer.h"
#include "core/diagnose/record_path.h"
#include "core/diagnose/replay_path.h"

namespace pl::diagnose {
namespace {

/// The technique of the direction that leads to a vertex.
Technique arrival_at(const PathRecord& path, std::uint32_t index) {
    return index == 0 ? Technique::Camera : path.vertices[index - 1].scattered->technique;
}

}  // namespace

std::vector<Contribution> contributions_of(const PathRecord& path) {
    std::vector<Contribution> all;
    const auto add = [&](Contribution contribution, Vec3f radiance) {
        contribution.light = static_cast<double>(luminance(radiance));
        if (contribution.light != 0.0) all.push_back(contribution);
    };
    for (std::uint32_t i = 0; i < path.vertices.size(); ++i) {
        const VertexRecord& vertex = path.vertices[i];
        if (!is_black(vertex.emission.contribution))
            add({.found_by = arrival_at(path, i), .bounces = i, .is_distant = vertex.is_escape},
                vertex.emission.contribution);
        if (vertex.light)
            add({.found_by = Technique::LightSampling,
                 .bounces = i + 1,
                 .is_distant = !vertex.light->position.has_value()},
                vertex.light->contribution);
    }
    return all;
}

std::string bounce_name(std::size_t bounces) {
    return bounces + 1 < kBounceClasses ? fmt::format("{}", bounces) : fmt::format("{} or more", bounces);
}

namespace {

constexpr std::size_t kFirstBounce = kTechniqueCount;
constexpr std::size_t kFirstLight = kTechniqueCount + kBounceClasses;

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
    for (std::size_t i = 0; i < kTechniqueCount; ++i) shares.found_by[i] = share(i);
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

PixelNoiseTracer::PixelNoiseTracer(PassPair passes, std::uint32_t pixel) : passes_(std::move(passes)), pixel_(pixel) {
    passes_.plain.path.stream = Stream::Inspection;
    if (!passes_.guided) return;
    passes_.guided->path.stream = Stream::Inspection;
    passes_.guided->runs = {{}};
    field_ = field_of(*passes_.guided);
}

bool PixelNoiseTracer::advance(const StopFlag* stop) {
    if (stop != nullptr && *stop) return false;
    // Every second round begins with the other method, so that neither always finds the scene in the cache.
    const bool is_guided_first = steps_ / kJackknifeGroups % 2 == 1;
    if (passes_.guided && is_guided_first) trace(*passes_.guided, field_, guided_);
    trace(passes_.plain, AnyFieldView{}, plain_);
    if (passes_.guided && !is_guided_first) trace(*passes_.guided, field_, guided_);
    ++steps_;
    return true;
}

void PixelNoiseTracer::trace(const PassReplay& passes, const AnyFieldView& field, NoiseSums& sums) const {
    const std::size_t group = steps_ % kJackknifeGroups;
    const std::uint32_t first = passes.samples + paths();
    const ThreadStopwatch watch;
    for (std::uint32_t i = 0; i < kPathsPerStep; ++i) replay_path(passes, field, pixel_, first + i);
    sums.add_seconds(group, watch.seconds());
    for (std::uint32_t i = 0; i < kPathsPerStep; ++i)
        sums.add(group, contributions_of(record_path(passes, field, pixel_, first + i)));
}

PixelNoise PixelNoiseTracer::noise() const {
    PixelNoise noise{.pixel = pixel_, .plain = plain_.estimate(), .guided_method = passes_.guided_method};
    if (!passes_.guided) return noise;
    noise.guided = guided_.estimate();
    noise.gain = pixel_gain(plain_, guided_);
    return noise;
}

}  // namespace pl::diagnose
