#include "core/fields/lobe_model.h"

#include <cmath>

#include <fmt/format.h>

namespace pl {
namespace {

FieldDamage wrong_value(const char* part, std::size_t i, double got) {
    return {"lobes", fmt::format("mixtures of 1 to {} lobes", kMostLobes),
            std::string(part) + " " + std::to_string(i) + ": got " + std::to_string(got)};
}

/// Relative density of the mixture of a volume, by direction.
auto density_of(const LobeField& field, std::uint32_t volume) {
    return [mixture = field.product_at(volume, Vec3f{0.0f}, {0.0f, 0.0f, 1.0f})](Vec3f local) {
        return relative_density(mixture, local);
    };
}

}  // namespace

float first_mean(std::size_t i) {
    const std::size_t lobe = i / 3;
    if (lobe >= kFirstLobes) return i % 3 == 2 ? 1.0f : 0.0f;
    const double turns_per_lobe = (std::sqrt(5.0) - 1.0) / 2.0;
    const double z = 1.0 - (static_cast<double>(lobe) + 0.5) / kFirstLobes;
    const double radius = std::sqrt(1.0 - z * z);
    const double angle = 2.0 * static_cast<double>(kPi) * turns_per_lobe * static_cast<double>(lobe);
    const double components[3] = {radius * std::cos(angle), radius * std::sin(angle), z};
    return static_cast<float>(components[i % 3]);
}

std::string LobeModel::text(const FieldShape&, const HostLobes&) { return fmt::format("up to {} lobes", kMostLobes); }

std::optional<FieldDamage> LobeModel::damage(const HostLobes& lobes) {
    for (std::size_t volume = 0; volume < volume_count(lobes); ++volume) {
        const std::uint32_t count = lobes.lobe_count[volume];
        if (count == 0 || count > kMostLobes) return wrong_value("lobes of volume", volume, count);
        double sum = 0.0;
        for (std::size_t lobe = volume * kMostLobes; lobe < volume * kMostLobes + count; ++lobe) {
            const Vec3f mean{lobes.mean[3 * lobe], lobes.mean[3 * lobe + 1], lobes.mean[3 * lobe + 2]};
            const float length = glm::length(mean);
            if (!(std::fabs(length - 1.0f) < 1.0e-4f))
                return wrong_value("mean of lobe", lobe, static_cast<double>(length));
            if (!(lobes.kappa[lobe] <= kMostKappa))
                return wrong_value("concentration of lobe", lobe, static_cast<double>(lobes.kappa[lobe]));
            if (!(lobes.inverse_distance[lobe] <= kMostInverseDistance))
                return wrong_value("inverse distance of lobe", lobe,
                                   static_cast<double>(lobes.inverse_distance[lobe]));
            sum += static_cast<double>(lobes.weight[lobe]);
        }
        if (!(std::fabs(sum - 1.0) < 1.0e-4)) return wrong_value("weights of volume", volume, sum);
    }
    return std::nullopt;
}

float relative_density(const LobeMixture& mixture, Vec3f local) {
    return relative_to_cosine(mixture.pdf_sa(local), local);
}

float LobeInspector::unvisited_share(std::uint32_t volume) const {
    constexpr float kDark = 0.01f;
    if (field.samples[volume] == 0) return 1.0f;
    float dark = 0.0f;
    for_each_cell_density(field.cells, density_of(field, volume),
                          [&](float density) { dark += density < kDark ? 1.0f : 0.0f; });
    return dark / static_cast<float>(field.cells.count());
}

float LobeInspector::entropy(std::uint32_t volume) const {
    return entropy_of_cells(field.cells, density_of(field, volume));
}

float LobeInspector::radiance(std::uint32_t volume, int cell) const {
    const float mean = mean_of_cell(field.cells, cell, [&](Vec2f square) {
        return field.radiance_pdf_sa(volume, Vec3f{0.0f}, square_to_cosine_hemisphere(square));
    });
    return mean * field.total[volume];
}

float LobeInspector::probability(std::uint32_t volume, int cell) const {
    const LobeMixture mixture = mixture_of(volume);
    const float mean = mean_of_cell(field.cells, cell, [&](Vec2f square) {
        return relative_density(mixture, square_to_cosine_hemisphere(square));
    });
    return mean / static_cast<float>(field.cells.count());
}

std::uint32_t LobeInspector::samples(std::uint32_t volume, int cell) const {
    return spread_samples(field.samples[volume], probability(volume, cell));
}

float LobeInspector::density(std::uint32_t volume, Vec2f square) const {
    return relative_density(mixture_of(volume), square_to_cosine_hemisphere(square));
}

}  // namespace pl
