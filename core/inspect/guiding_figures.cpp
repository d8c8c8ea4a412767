#include "core/inspect/guiding_figures.h"

#include <bit>
#include <cmath>
#include <numeric>

#include "core/measure/statistics.h"
#include "core/session/path_settings.h"

namespace pl {
namespace {

/// Mean over a set of groups. [cell]
std::vector<double> mean_of(const std::vector<double>& groups, std::size_t cells, GroupSet set) {
    std::vector<double> mean(cells, 0.0);
    const double weight = 1.0 / std::popcount(set);
    for (std::size_t group = 0; group < kLightGroups; ++group) {
        if ((set >> group & 1u) == 0) continue;
        for (std::size_t cell = 0; cell < cells; ++cell) mean[cell] += weight * groups[group * cells + cell];
    }
    return mean;
}

double total_of(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

std::vector<float> to_floats(const std::vector<double>& values) { return {values.begin(), values.end()}; }

/// Of the probabilities in proportion to `light` from others, nats; 0 without light.
double divergence(const std::vector<double>& light, const std::vector<float>& shares) {
    const double total = total_of(light);
    double sum = 0.0;
    for (std::size_t cell = 0; cell < light.size(); ++cell)
        if (light[cell] > 0.0)
            sum += light[cell] / total * std::log(light[cell] / (total * static_cast<double>(shares[cell])));
    return sum;
}

/// Variance of light / probability of one sampled cell, relative to the squared total. `a` and `b` are independent estimates of
/// the light: their product has no bias.
double relative_variance(const std::vector<double>& a, const std::vector<double>& b,
                         const std::vector<float>& shares) {
    double second = 0.0;
    for (std::size_t cell = 0; cell < a.size(); ++cell)
        if (shares[cell] > 0.0f) second += a[cell] * b[cell] / static_cast<double>(shares[cell]);
    return second / (total_of(a) * total_of(b)) - 1.0;
}

/// Share of an emission that is left to the path's direction: the balance heuristic against light samples.
double path_share(const SampledEmission& emission, const IncidentLight& light, const VolumeInspection& volume,
                  TargetLight target) {
    if (target == TargetLight::All) return 1.0;
    double pdf = 1.0;
    if (target == TargetLight::LeftByPaths) {
        const float a = volume.bsdf_fraction;
        pdf = static_cast<double>(light.guided_share *
                                  (a * emission.bsdf_pdf + (1.0f - a) * volume.density[emission.fine_cell]));
    }
    return pdf / (pdf + static_cast<double>(emission.light_pdf));
}

}  // namespace

TargetLight target_light(const RenderSettings& settings, MethodId method) {
    if (!settings.next_event) return TargetLight::All;
    if (!info_of(method).learns) return TargetLight::LeftByProbes;
    return settings.field.learning.light == LearnedLight::All ? TargetLight::All : TargetLight::LeftByPaths;
}

std::vector<float> mixture_shares(const IncidentLight& light, const VolumeInspection& volume) {
    std::vector<float> shares = cell_shares(volume.side, volume.density);
    for (std::size_t cell = 0; cell < shares.size(); ++cell)
        shares[cell] += volume.bsdf_fraction * (light.bsdf_share[cell] - shares[cell]);
    return shares;
}

LightComparison::LightComparison(const IncidentLight& light, const VolumeInspection& volume, TargetLight target)
    : cells_(light.cells()), table_(volume.probability), mixture_(mixture_shares(light, volume)),
      bsdf_(light.bsdf_share), radiance_(light.radiance), target_(light.radiance), product_(light.reflected) {
    for (const SampledEmission& emission : light.emission) {
        const std::size_t index = emission.group * cells_ + emission.cell;
        const double share = path_share(emission, light, volume, target);
        radiance_[index] += static_cast<double>(emission.radiance);
        target_[index] += share * static_cast<double>(emission.radiance);
        product_[index] += share * static_cast<double>(emission.reflected);
    }
    for (std::size_t index = 0; index < radiance_.size(); ++index) {
        const double paths = light.paths[index / cells_];
        radiance_[index] /= paths;
        target_[index] /= paths;
        product_[index] /= paths;
    }
}

TrueLight LightComparison::true_light() const {
    const std::vector<double> radiance = mean_of(radiance_, cells_, kAllGroups);
    std::vector<double> error(cells_, 0.0);
    for (std::size_t index = 0; index < radiance_.size(); ++index) {
        const double difference = radiance_[index] - radiance[index % cells_];
        error[index % cells_] += difference * difference;
    }
    for (double& e : error) e = std::sqrt(e / (kLightGroups * (kLightGroups - 1)));
    return {.radiance = to_floats(radiance),
            .radiance_error = to_floats(error),
            .target = to_floats(mean_of(target_, cells_, kAllGroups)),
            .product = to_floats(mean_of(product_, cells_, kAllGroups))};
}

std::vector<float> LightComparison::product_shares() const {
    std::vector<double> shares = mean_of(product_, cells_, kAllGroups);
    const double total = total_of(shares);
    if (total > 0.0)
        for (double& share : shares) share /= total;
    return to_floats(shares);
}

GuidingFigures LightComparison::figures() const {
    const auto divergence_from = [&](const std::vector<double>& light, const std::vector<float>& shares) {
        const GroupFigure figure = [&](GroupSet set) { return divergence(mean_of(light, cells_, set), shares); };
        return jackknife_interval([&](GroupSet set) { return without_bias(figure, set); });
    };
    const auto variance_of = [&](const std::vector<float>& shares, GroupSet set) {
        return relative_variance(mean_of(product_, cells_, set & kEvenGroups),
                                 mean_of(product_, cells_, set & kOddGroups), shares);
    };
    GuidingFigures figures{.table = divergence_from(target_, table_),
                           .mixture = divergence_from(product_, mixture_),
                           .variance_factor = {}};
    const Interval by_bsdf = jackknife_interval([&](GroupSet set) { return variance_of(bsdf_, set); });
    if (by_bsdf.low > 0.0)
        figures.variance_factor =
            jackknife_interval([&](GroupSet set) { return variance_of(mixture_, set) / variance_of(bsdf_, set); });
    return figures;
}

LightReport report_light(const IncidentLight& light, const VolumeInspection& volume, TargetLight target) {
    const LightComparison comparison(light, volume, target);
    return {.paths_per_cell = light.paths_per_cell(),
            .invalid_paths = light.invalid_paths,
            .target = target,
            .light = comparison.true_light(),
            .product_shares = comparison.product_shares(),
            .mixture_shares = comparison.mixture(),
            .figures = comparison.figures()};
}

}  // namespace pl
