// Divergences and variance factors from light with known cells and known noise.
#include "core/inspect/guiding_figures.h"

#include <cmath>
#include <numeric>
#include <random>

#include "tests/support/catch.hpp"

using namespace pl;

namespace {

constexpr int kSide = 8;
constexpr std::size_t kCells = kSide * kSide;

/// Cells of a dim wall with a bright part: shares of the light.
std::vector<double> true_shares() {
    std::vector<double> shares(kCells, 1.0);
    for (std::size_t i = 20; i < 24; ++i) shares[i] = 12.0;
    const double total = std::accumulate(shares.begin(), shares.end(), 0.0);
    for (double& share : shares) share /= total;
    return shares;
}

/// Light of these shares, each path with exponential noise of the same relative size; Lambert reflector of albedo 1.
IncidentLight noisy_light(const std::vector<double>& shares, double noise, std::uint32_t paths,
                          std::mt19937& random) {
    IncidentLight light{.side = kSide};
    light.paths.fill(paths);
    light.bsdf_share.assign(kCells, 1.0f / kCells);
    std::exponential_distribution<double> exponential(1.0);
    for (int group = 0; group < kLightGroups; ++group)
        for (std::size_t cell = 0; cell < kCells; ++cell) {
            double sum = 0.0;
            for (std::uint32_t i = 0; i < paths; ++i)
                sum += shares[cell] * (1.0 + noise * (exponential(random) - 1.0));
            light.radiance.push_back(sum);
        }
    light.reflected = light.radiance;
    return light;
}

/// A volume whose table, and field density, has these probabilities.
VolumeInspection volume_with(const std::vector<double>& shares, float bsdf_fraction) {
    VolumeInspection volume;
    volume.side = kSide;
    volume.bsdf_fraction = bsdf_fraction;
    volume.probability.assign(shares.begin(), shares.end());
    const int points = kSide * kFinePoints;
    for (int i = 0; i < points * points; ++i) {
        const int cell = (i / points / kFinePoints) * kSide + i % points / kFinePoints;
        volume.density.push_back(static_cast<float>(shares[static_cast<std::size_t>(cell)] * kCells));
    }
    return volume;
}

/// 2 % more in every other cell, 2 % less in the rest.
std::vector<double> two_percent_off(std::vector<double> shares) {
    for (std::size_t cell = 0; cell < shares.size(); ++cell) shares[cell] *= cell % 2 == 0 ? 1.02 : 0.98;
    const double total = std::accumulate(shares.begin(), shares.end(), 0.0);
    for (double& share : shares) share /= total;
    return shares;
}

double exact_divergence(const std::vector<double>& p, const std::vector<double>& q) {
    double sum = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) sum += p[i] * std::log(p[i] / q[i]);
    return sum;
}

}  // namespace

// 300 experiments, seed 1: 64 cells, 32 x 8 paths, noise as large as the light. The mean divergence has a standard error of 1e-4,
// and the plug-in value is (64 - 1) / (2 x 256) x (share-weighted) = 0.1 too high: five standard errors leave no room for it. A
// nominal 95 % interval holds zero in at least 85 % of the experiments: if it held it in 80 %, 85 % would be seen in less than 2 %.
TEST_CASE("The divergence of a table that is the truth is zero within its interval") {
    std::mt19937 random(1);
    const VolumeInspection volume = volume_with(true_shares(), 0.0f);
    double mean = 0.0;
    int held = 0;
    constexpr int kExperiments = 300;
    for (int i = 0; i < kExperiments; ++i) {
        const IncidentLight light = noisy_light(true_shares(), 1.0, 8, random);
        const GuidingFigures figures = LightComparison(light, volume, TargetLight::All).figures();
        mean += figures.table.value / kExperiments;
        held += figures.table.contains(0.0) ? 1 : 0;
    }
    INFO("mean " << mean << ", held " << held);
    CHECK(std::fabs(mean) < 0.003);
    CHECK(held >= 255);
}

// 100 experiments, seed 2: noise of 5 %, 32 x 64 paths; the divergence of the planted error is 2e-4, its standard error 4e-6.
TEST_CASE("The divergence of a table with 2 % of error is seen") {
    std::mt19937 random(2);
    const std::vector<double> truth = true_shares();
    const double planted = exact_divergence(truth, two_percent_off(truth));
    CHECK_THAT(planted, WithinRel(2.0e-4, 0.02));
    const VolumeInspection wrong = volume_with(two_percent_off(truth), 0.0f);
    const VolumeInspection right = volume_with(truth, 0.0f);
    int seen = 0;
    int false_alarms = 0;
    double mean = 0.0;
    constexpr int kExperiments = 100;
    for (int i = 0; i < kExperiments; ++i) {
        const IncidentLight light = noisy_light(truth, 0.05, 64, random);
        const Interval found = LightComparison(light, wrong, TargetLight::All).figures().table;
        mean += found.value / kExperiments;
        seen += found.low > 0.0 && found.contains(planted) ? 1 : 0;
        false_alarms += LightComparison(light, right, TargetLight::All).figures().table.low > 0.0 ? 1 : 0;
    }
    INFO("seen " << seen << ", false alarms " << false_alarms << ", mean " << mean << " of " << planted);
    CHECK(seen >= 80);
    CHECK(false_alarms <= 15);
    CHECK_THAT(mean, WithinRel(planted, 0.02));
}

TEST_CASE("Without noise all figures are those of the closed form") {
    std::mt19937 random(3);
    const std::vector<double> truth = true_shares();
    const std::vector<double> uniform(kCells, 1.0 / kCells);
    const IncidentLight light = noisy_light(truth, 0.0, 1, random);
    for (const float fraction : {0.0f, 0.5f, 1.0f}) {
        const VolumeInspection volume = volume_with(truth, fraction);
        const LightComparison comparison(light, volume, TargetLight::All);
        std::vector<double> mixture(kCells);
        double mixed = 0.0;
        double plain = 0.0;
        for (std::size_t cell = 0; cell < kCells; ++cell) {
            mixture[cell] =
                static_cast<double>(fraction) / kCells + (1.0 - static_cast<double>(fraction)) * truth[cell];
            CHECK_THAT(static_cast<double>(comparison.mixture()[cell]), WithinRel(mixture[cell], 1.0e-5));
            mixed += truth[cell] * truth[cell] / mixture[cell];
            plain += truth[cell] * truth[cell] * kCells;
        }
        const GuidingFigures figures = comparison.figures();
        CHECK_THAT(figures.table.value, WithinAbs(0.0, 1.0e-6));
        CHECK_THAT(figures.mixture.value, WithinAbs(exact_divergence(truth, mixture), 1.0e-6));
        REQUIRE(figures.variance_factor);
        CHECK_THAT(figures.variance_factor->value, WithinAbs((mixed - 1.0) / (plain - 1.0), 1.0e-5));
    }
}

TEST_CASE("Even light leaves BSDF sampling no variance to be reduced") {
    std::mt19937 random(4);
    const std::vector<double> uniform(kCells, 1.0 / kCells);
    const VolumeInspection volume = volume_with(true_shares(), 0.5f);
    const IncidentLight light = noisy_light(uniform, 0.3, 16, random);
    CHECK_FALSE(LightComparison(light, volume, TargetLight::All).figures().variance_factor);
}

TEST_CASE("Emission is left to the paths by the balance heuristic") {
    const std::vector<double> uniform(kCells, 1.0 / kCells);
    VolumeInspection volume = volume_with(uniform, 0.25f);
    IncidentLight light{.side = kSide};
    light.paths.fill(1);
    light.bsdf_share.assign(kCells, 1.0f / kCells);
    light.radiance.assign(kCells * kLightGroups, 0.0);
    light.reflected.assign(kCells * kLightGroups, 0.0);
    light.guided_share = 0.5f;
    for (std::uint32_t group = 0; group < kLightGroups; ++group)
        light.emission.push_back({.cell = 3,
                                  .group = group,
                                  .fine_cell = 12,
                                  .light_pdf = 4.0f,
                                  .bsdf_pdf = 2.0f,
                                  .radiance = 10.0f,
                                  .reflected = 6.0f});
    volume.density[12] = 3.0f;
    const auto target_of = [&](TargetLight target) { return LightComparison(light, volume, target).true_light(); };
    CHECK(target_of(TargetLight::All).target[3] == 10.0f);
    // (1 - delta share) (a p_bsdf + (1 - a) p_field) = 0.5 (0.5 + 2.25) = 1.375
    const TrueLight left = target_of(TargetLight::LeftByPaths);
    CHECK_THAT(left.target[3], WithinRel(10.0f * 1.375f / 5.375f, 1.0e-5f));
    CHECK_THAT(left.product[3], WithinRel(6.0f * 1.375f / 5.375f, 1.0e-5f));
    CHECK(left.radiance[3] == 10.0f);
    CHECK_THAT(target_of(TargetLight::LeftByProbes).target[3], WithinRel(10.0f / 5.0f, 1.0e-5f));
}

TEST_CASE("The target light follows method and settings") {
    RenderSettings settings{.next_event = false};
    CHECK(target_light(settings, MethodId::Reinforcement) == TargetLight::All);
    settings.next_event = true;
    CHECK(target_light(settings, MethodId::Reinforcement) == TargetLight::LeftByPaths);
    CHECK(target_light(settings, MethodId::Precomputed) == TargetLight::LeftByProbes);
    settings.field.learning.light = LearnedLight::All;
    CHECK(target_light(settings, MethodId::Reinforcement) == TargetLight::All);
}
