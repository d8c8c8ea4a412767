#include "core/fields/neural_model.h"

#include <cmath>

#include "core/fields/lobe_model.h"

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

void reset_network(HostNeural& field) {
    constexpr float kFirstFeature = 0.05f;
    for_each_network_array([&](const auto& spec) { spec.get(field).assign(spec.length, {}); });
    field.counts[kNetworkVersion] = kNetworkLayoutVersion;
    // The last layer stays 0, so that an untrained network changes nothing.
    for (std::size_t i = 0; i < kFirstLayer; ++i) field.weights[i] = kFirstFeature * scattered(i);
    const float first = std::sqrt(6.0f / static_cast<float>(kConstantInput));
    const float second = std::sqrt(6.0f / static_cast<float>(kHiddenUnits));
    for (std::size_t i = kFirstLayer; i < kSecondLayer; ++i) field.weights[i] = first * scattered(i);
    for (std::size_t i = kSecondLayer; i < kSecondLayer + std::size_t{kHiddenUnits} * kHiddenUnits; ++i)
        field.weights[i] = second * scattered(i);
    field.average = field.weights;
}

HostNeural make_neural(const FieldShape& shape, std::size_t volumes) {
    HostNeural field;
    static_cast<HostTables&>(field) = make_tables(shape, volumes);
    reset_network(field);
    return field;
}

bool fits(const FieldShape& shape, const HostNeural& field, std::size_t volumes) {
    bool all = fits(shape, static_cast<const HostTables&>(field), volumes);
    for_each_network_array([&](const auto& spec) { all = all && spec.get(field).size() == spec.length; });
    return all;
}

std::size_t network_bytes() { return 4 * kNetworkWeights * sizeof(float) + kNetworkCounts * sizeof(std::uint32_t); }

std::size_t field_bytes(const HostNeural& field) {
    std::size_t bytes = field_bytes(static_cast<const HostTables&>(field));
    for_each_network_array(
        [&](const auto& spec) { bytes += spec.get(field).size() * sizeof *spec.get(field).data(); });
    return bytes;
}

NetworkStatus status_of(const HostNeural& field) {
    if (field.counts.size() != kNetworkCounts) return {};  // of a method without a field
    return {.steps = field.counts[kNetworkSteps], .is_lost = field.counts[kNetworkIsLost] != 0};
}

std::optional<std::string> damage_of(const HostNeural& field) {
    if (field.counts[kNetworkVersion] != kNetworkLayoutVersion)
        return "layout " + std::to_string(field.counts[kNetworkVersion]);
    if (field.counts[kNetworkIsLost] > 1) return "mark of loss " + std::to_string(field.counts[kNetworkIsLost]);
    return std::nullopt;
}

HostNeural split_field(const FieldShape& shape, HostNeural field, std::span<const std::uint32_t> parents) {
    static_cast<HostTables&>(field) = split_field(shape, static_cast<HostTables&&>(field), parents);
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

}  // namespace pl
