// A network that is evaluated at every vertex, and the tables that teach it. The network's arrays are those of a neural field, and the
// running means of the weights, by which kernels sample.
#pragma once

#include "core/fields/neural_model.h"
#include "core/kernel/guiding/neural_vertex_field.h"

namespace pl {

template <template <class> class Array>
struct NeuralVertexStorage : NeuralStorage<Array> {
    Array<float> average;  ///< exponential running mean of each weight over the steps of gradient descent
};
using HostNeuralVertex = NeuralVertexStorage<LargeArray>;

/// Calls fn(spec) for every array of the network, in the order of files.
template <class Fn>
constexpr void for_each_vertex_array(Fn&& fn) {
    for_each_network_array(fn);
    const auto average = [](auto& network) -> auto& { return network.average; };
    fn(NetworkSpec{"averages of weights", "average", ValidRange::Finite, average});
}

/// Calls fn(array of `from`, array of `to`) for every array; `to` is const if fn only reads it.
template <template <class> class From, class To, class Fn>
void zip(const NeuralVertexStorage<From>& from, To& to, Fn&& fn) {
    for_each_table_array([&](const auto& spec) { fn(spec.get(from), spec.get(to)); });
    for_each_vertex_array([&](const auto& spec) { fn(spec.get(from), spec.get(to)); });
}

/// Uniform tables, and a network whose mixture is nearly the cosine everywhere.
HostNeuralVertex make_neural_vertex(const FieldShape& shape, std::size_t volumes);

/// Gives the network the weights of make_neural_vertex() and forgets its steps.
void reset_network(HostNeuralVertex& field);

/// Whether all arrays have the length that follows from the shape and the number of volumes.
bool fits(const FieldShape& shape, const HostNeuralVertex& field, std::size_t volumes);

/// Bytes of the network's arrays. Those of a volume are table_bytes().
std::size_t vertex_network_bytes();
std::size_t field_bytes(const HostNeuralVertex& field);

NetworkStatus status_of(const HostNeuralVertex& field);

/// Divides the tables as split_field() of HostTables does. The network, a function of the place, stays.
HostNeuralVertex split_field(const FieldShape& shape, HostNeuralVertex field, std::span<const std::uint32_t> parents);

/// evaluate_vertex() by floats.
void evaluate_vertex_network(const float* weights, const float* inputs, float* outputs);

/// A back end may set `evaluate` of the view to a faster function with the same bits.
template <template <class> class Array, template <class> class FieldArray>
NeuralVertexField field_view(const FieldShape& shape, const VolumeStorage<Array>& volumes,
                             NeuralVertexStorage<FieldArray>& arrays) {
    NeuralVertexField field;
    static_cast<TableField&>(field) = field_view(shape, volumes, static_cast<TableStorage<FieldArray>&>(arrays));
    field.evaluate = evaluate_vertex_network;
    field.weights = view_of(arrays.average);
    field.corner = shape.corner;
    field.edge = shape.edge;
    field.counts = view_of(arrays.counts);
    return field;
}

/// VolumeSummary: of the mixtures at the sites of volumes, beside the tables' numbers.
struct NeuralVertexSummary : TableVolumeSummary {
    NeuralVertexField mixtures;

    /// Of the mixture over as many cells of the hemisphere as tables have.
    float entropy(std::uint32_t volume) const;
};
static_assert(VolumeSummary<NeuralVertexSummary>);

/// The mixture at the site of a volume.
VertexMixture mixture_of_volume(const NeuralVertexField& field, std::uint32_t volume);
/// Its density in a direction of the volume's hemisphere relative to that of cosine sampling. `local` in the frame of the normal.
float relative_density(const NeuralVertexField& field, std::uint32_t volume, const VertexMixture& mixture,
                       Vec3f local);

template <template <class> class Array>
NeuralVertexSummary summary_of(const FieldShape& shape, const HostVolumes& volumes,
                               NeuralVertexStorage<Array>& field) {
    return {{update_view(shape, static_cast<TableStorage<Array>&>(field))}, field_view(shape, volumes, field)};
}

}  // namespace pl
