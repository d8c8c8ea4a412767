#include "core/fields/lobe_model.h"

#include <cmath>

namespace pl {
namespace {

std::string wrong_value(const char* part, std::size_t i, double got) {
    return std::string(part) + " " + std::to_string(i) + ": got " + std::to_string(got);
}

/// Relative density of the mixture of a volume, by direction.
auto density_of(const LobeField& field, std::uint32_t volume) {
    return [mixture = field.product_at(volume, Vec3f{0.0f}, {0.0f, 0.0f, 1.0f})](Vec3f local) {
        return relative_density(mixture, local);
    };
}

/// Gives the values [first, first + length) those of a volume without training samples.
template <class Spec, class Array>
void make_fresh(const Spec& spec, Array& values, std::size_t first, std::size_t length) {
    using Value = typename Array::value_type;
    for (std::size_t i = 0; i < length; ++i) values[first + i] = static_cast<Value>(spec.initial(i));
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

std::size_t extent_of(LobeExtent extent, const FieldShape& shape, std::size_t volumes) {
    switch (extent) {
    case LobeExtent::Lobe: return volumes * kMostLobes;
    case LobeExtent::LobeAxis: return volumes * kMostLobes * 3;
    case LobeExtent::LobeStatistic: return volumes * kMostLobes * kLobeMoments;
    case LobeExtent::Volume: return volumes;
    case LobeExtent::LightCluster: return volumes * shape.light_clusters;
    }
    return 0;
}

HostLobes make_lobes(const FieldShape& shape, std::size_t volumes) {
    HostLobes lobes;
    for_each_lobe_array([&](const auto& spec) {
        auto& values = spec.get(lobes);
        values.resize(extent_of(spec.extent, shape, volumes));
        const std::size_t length = extent_of(spec.extent, shape, 1);
        for (std::size_t volume = 0; volume < volumes; ++volume) make_fresh(spec, values, volume * length, length);
    });
    return lobes;
}

void reset_lobes(const FieldShape& shape, HostLobes& lobes, std::size_t volume) {
    for_each_lobe_array([&](const auto& spec) {
        const std::size_t length = extent_of(spec.extent, shape, 1);
        make_fresh(spec, spec.get(lobes), volume * length, length);
    });
}

bool fits(const FieldShape& shape, const HostLobes& lobes, std::size_t volumes) {
    bool all = true;
    for_each_lobe_array(
        [&](const auto& spec) { all = all && spec.get(lobes).size() == extent_of(spec.extent, shape, volumes); });
    return all;
}

std::size_t field_bytes(const HostLobes& lobes) {
    std::size_t bytes = 0;
    for_each_lobe_array([&](const auto& spec) { bytes += spec.get(lobes).size() * sizeof *spec.get(lobes).data(); });
    return bytes;
}

std::size_t lobe_bytes(std::size_t light_clusters) {
    const FieldShape shape{.cells = {}, .light_clusters = static_cast<std::uint32_t>(light_clusters)};
    const HostLobes lobes;
    std::size_t bytes = 0;
    for_each_lobe_array(
        [&](const auto& spec) { bytes += extent_of(spec.extent, shape, 1) * sizeof *spec.get(lobes).data(); });
    return bytes;
}

HostLobes split_field(const FieldShape& shape, HostLobes lobes, std::span<const std::uint32_t> parents) {
    const std::size_t volumes = volume_count(lobes);
    for_each_lobe_array([&](const auto& spec) {
        auto& values = spec.get(lobes);
        const std::size_t length = extent_of(spec.extent, shape, 1);
        values.resize((volumes + parents.size()) * length);
        for (std::size_t i = 0; i < parents.size() * length; ++i) {
            using Value = std::remove_cvref_t<decltype(values[0])>;
            auto& parent = values[parents[i / length] * length + i % length];
            auto& child = values[volumes * length + i];
            if (spec.on_split == OnSplit::Copy) child = parent;
            if (spec.on_split == OnSplit::Clear || spec.on_split == OnSplit::Copy) continue;
            child = parent / static_cast<Value>(2);
            parent -= child;
        }
    });
    return lobes;
}

std::optional<std::string> damage_of(const HostLobes& lobes) {
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

float LobeVolumeSummary::unvisited_share(std::uint32_t volume) const {
    constexpr float kDark = 0.01f;
    if (field.samples[volume] == 0) return 1.0f;
    float dark = 0.0f;
    for_each_cell_density(field.cells, density_of(field, volume),
                          [&](float density) { dark += density < kDark ? 1.0f : 0.0f; });
    return dark / static_cast<float>(field.cells.count());
}

float LobeVolumeSummary::entropy(std::uint32_t volume) const {
    return entropy_of_cells(field.cells, density_of(field, volume));
}

}  // namespace pl
