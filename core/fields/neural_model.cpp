#include "core/fields/neural_model.h"

#include <cmath>

#include <fmt/format.h>

namespace pl {
namespace {

/// A number in [-1, 1) of its own for every index.   [PCG hash: Jarzynski and Olano 2020]
float scattered(std::size_t i) {
    const std::uint32_t state = static_cast<std::uint32_t>(i) * 747796405u + 2891336453u;
    const std::uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
    return static_cast<float>((word >> 22) ^ word) * 0x1p-31f - 1.0f;
}

}  // namespace

void evaluate_vertex_network(const float* weights, const float* inputs, float* outputs) {
    evaluate_vertex<float>(weights, inputs, outputs);
}

float first_network_weight(std::size_t i) {
    constexpr float kFirstFeature = 0.05f;
    const float first = std::sqrt(6.0f / static_cast<float>(kConstantInput));
    const float second = std::sqrt(6.0f / static_cast<float>(kHiddenUnits));
    if (i < kFirstLayer) return kFirstFeature * scattered(i);
    if (i < kSecondLayer) return first * scattered(i);
    return i < kSecondLayer + std::size_t{kHiddenUnits} * kHiddenUnits ? second * scattered(i) : 0.0f;
}

void reset_network(HostNeural& field) {
    for_each_network_array(
        [&](const auto& spec) { reset_values(spec, {}, spec.get(field), 0, spec.get(field).size()); });
}

std::string NeuralModel::text(const FieldShape&, const HostNeural& field) {
    return fmt::format("{} lobes at each vertex by a network of {} steps", kVertexLobes, network(field).steps);
}

NetworkStatus NeuralModel::network(const HostNeural& field) {
    if (field.counts.size() != kNetworkCounts) return {};  // of a method without a field
    return {.steps = field.counts[kNetworkSteps], .is_lost = field.counts[kNetworkIsLost] != 0};
}

std::optional<FieldDamage> NeuralModel::damage(const HostNeural& field) {
    if (auto damage = TableModel::damage(field)) return damage;
    const auto wrong = [](const char* what, std::uint32_t got) {
        return FieldDamage{"network", fmt::format("weights of layout {}", kNetworkLayoutVersion),
                           fmt::format("{} {}", what, got)};
    };
    if (field.counts[kNetworkVersion] != kNetworkLayoutVersion) return wrong("layout", field.counts[kNetworkVersion]);
    if (field.counts[kNetworkIsLost] > 1) return wrong("mark of loss", field.counts[kNetworkIsLost]);
    return std::nullopt;
}

HostNeural NeuralModel::split(const FieldShape& shape, HostNeural field, std::span<const std::uint32_t> parents) {
    static_cast<HostTables&>(field) = TableModel::split(shape, static_cast<HostTables&&>(field), parents);
    return field;
}

VertexMixture mixture_of_volume(const NeuralField& field, std::uint32_t volume) {
    return field.mixture_at(field.sites[volume].position, field.normals[volume]);
}

float relative_density(const NeuralField& field, std::uint32_t volume, const VertexMixture& mixture, Vec3f local) {
    return relative_to_cosine(mixture.pdf_sa(field.frame(static_cast<std::int32_t>(volume)).to_world(local)), local);
}

float NeuralSummary::entropy(std::uint32_t volume) const {
    const VertexMixture mixture = mixture_of_volume(mixtures, volume);
    return entropy_of_cells(mixtures.cells,
                            [&](Vec3f local) { return relative_density(mixtures, volume, mixture, local); });
}

NeuralInspector NeuralModel::inspector(const NeuralField& field) {
    NeuralInspector inspector;
    inspector.field = inspector.mixtures = field;
    return inspector;
}

const VertexMixture& NeuralInspector::mixture_of(std::uint32_t volume) const {
    if (mixture_volume_ != volume) mixture_ = mixture_of_volume(mixtures, volume);
    mixture_volume_ = volume;
    return mixture_;
}

float NeuralInspector::probability(std::uint32_t volume, int cell) const {
    const float mean = mean_of_cell(mixtures.cells, cell, [&](Vec2f square) { return density(volume, square); });
    return mean / static_cast<float>(mixtures.cells.count());
}

float NeuralInspector::density(std::uint32_t volume, Vec2f square) const {
    return relative_density(mixtures, volume, mixture_of(volume), square_to_cosine_hemisphere(square));
}

}  // namespace pl
