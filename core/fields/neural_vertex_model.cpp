#include "core/fields/neural_vertex_model.h"

#include <cmath>

#include "core/fields/lobe_model.h"

namespace pl {

void evaluate_vertex_network(const float* weights, const float* inputs, float* outputs) {
    evaluate_vertex<float>(weights, inputs, outputs);
}

void reset_network(HostNeuralVertex& field) {
    reset_network(kVertexLayout, field);
    field.average = field.weights;
}

HostNeuralVertex make_neural_vertex(const FieldShape& shape, std::size_t volumes) {
    HostNeuralVertex field;
    static_cast<HostTables&>(field) = make_tables(shape, volumes);
    reset_network(field);
    return field;
}

bool fits(const FieldShape& shape, const HostNeuralVertex& field, std::size_t volumes) {
    bool all = fits(shape, static_cast<const HostTables&>(field), volumes) && field.counts.size() == kNetworkCounts;
    for (const auto* array : {&field.weights, &field.slope_mean, &field.slope_square, &field.average})
        all = all && array->size() == kVertexLayout.count;
    return all;
}

std::size_t vertex_network_bytes() {
    return 4 * kVertexLayout.count * sizeof(float) + kNetworkCounts * sizeof(std::uint32_t);
}

std::size_t field_bytes(const HostNeuralVertex& field) {
    return field_bytes(static_cast<const HostTables&>(field)) + status_of(field).bytes;
}

NetworkStatus status_of(const HostNeuralVertex& field) {
    NetworkStatus status = status_of(static_cast<const HostNeural&>(field));
    status.bytes += field.average.size() * sizeof(float);
    return status;
}

HostNeuralVertex split_field(const FieldShape& shape, HostNeuralVertex field,
                             std::span<const std::uint32_t> parents) {
    static_cast<HostTables&>(field) = split_field(shape, static_cast<HostTables&&>(field), parents);
    return field;
}

VertexMixture mixture_of_volume(const NeuralVertexField& field, std::uint32_t volume) {
    return field.mixture_at(field.sites[volume].position, field.normals[volume]);
}

float relative_density(const NeuralVertexField& field, std::uint32_t volume, const VertexMixture& mixture,
                       Vec3f local) {
    return relative_to_cosine(mixture.pdf_sa(field.frame(static_cast<std::int32_t>(volume)).to_world(local)), local);
}

float NeuralVertexSummary::entropy(std::uint32_t volume) const {
    const VertexMixture mixture = mixture_of_volume(mixtures, volume);
    return entropy_of_cells(mixtures.cells,
                            [&](Vec3f local) { return relative_density(mixtures, volume, mixture, local); });
}

}  // namespace pl
