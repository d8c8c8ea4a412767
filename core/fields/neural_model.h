// A neural field: a network that is evaluated at every vertex, by whose mixtures kernels sample, and the tables that teach it. The one
// description of the network's arrays, and all code derived from it; the tables' are in table_model.h.
#pragma once

#include <optional>
#include <string>

#include "core/fields/table_model.h"
#include "core/kernel/guiding/neural_field.h"

namespace pl {

/// The tables keep the learned radiance. The network is taught by them in every update, see cpu/learning/neural_update.h.
template <template <class> class Array>
struct NeuralStorage : TableStorage<Array> {
    Array<float> weights;         ///< of grids and layers, see network_layout.h
    Array<float> slope_mean;      ///< of Adam: running mean of the slope of each weight
    Array<float> slope_square;    ///< and of its square
    Array<std::uint32_t> counts;  ///< by NetworkCount
    Array<float> average;         ///< exponential running mean of each weight over the steps of gradient descent
};
using HostNeural = NeuralStorage<LargeArray>;

/// State of a network, as a session tells it.
struct NetworkStatus {
    std::uint64_t steps = 0;  ///< of gradient descent
    bool is_lost = false;     ///< see kNetworkIsLost
};

/// Description of one array of a network.
template <class Get>
struct NetworkSpec {
    const char* name;    ///< plural, in messages
    const char* single;  ///< of one value, in messages
    std::size_t length;
    ValidRange valid;
    Get get;  ///< the array of any NeuralStorage
};
template <class Get>
NetworkSpec(const char*, const char*, std::size_t, ValidRange, Get) -> NetworkSpec<Get>;

namespace network_arrays {

using enum ValidRange;

/// The arrays in the order of files, behind those of the tables.
// clang-format off
inline constexpr SpecList kAll{
    NetworkSpec{"weights of the network", "weight", kNetworkWeights, Finite, [](auto& n) -> auto& { return n.weights; }},
    NetworkSpec{"slopes of the network", "slope", kNetworkWeights, Finite, [](auto& n) -> auto& { return n.slope_mean; }},
    NetworkSpec{"squares of slopes", "square of the slope", kNetworkWeights, Amount, [](auto& n) -> auto& { return n.slope_square; }},
    NetworkSpec{"counts of the network", "count", kNetworkCounts, Any, [](auto& n) -> auto& { return n.counts; }},
    NetworkSpec{"averages of weights", "average", kNetworkWeights, Finite, [](auto& n) -> auto& { return n.average; }},
};
// clang-format on

}  // namespace network_arrays

/// Calls fn(spec) for every array of the network.
template <class Fn>
constexpr void for_each_network_array(Fn&& fn) {
    for_each_spec(network_arrays::kAll, fn);
}

/// Calls fn(array of `from`, array of `to`) for every array; `to` is const if fn only reads it.
template <template <class> class From, class To, class Fn>
void zip(const NeuralStorage<From>& from, To& to, Fn&& fn) {
    for_each_table_array([&](const auto& spec) { fn(spec.get(from), spec.get(to)); });
    for_each_network_array([&](const auto& spec) { fn(spec.get(from), spec.get(to)); });
}

/// Uniform tables, and a network whose mixture is nearly the cosine everywhere.
HostNeural make_neural(const FieldShape& shape, std::size_t volumes);

/// Gives the network the weights of make_neural() and forgets its steps.
void reset_network(HostNeural& field);

/// Whether all arrays have the length that follows from the shape and the number of volumes.
bool fits(const FieldShape& shape, const HostNeural& field, std::size_t volumes);

/// Bytes of the network's arrays. Those of a volume are table_bytes().
std::size_t network_bytes();
std::size_t field_bytes(const HostNeural& field);

NetworkStatus status_of(const HostNeural& field);

/// Divides the tables as split_field() of HostTables does. The network, a function of the place, stays.
HostNeural split_field(const FieldShape& shape, HostNeural field, std::span<const std::uint32_t> parents);

/// The damage of counts of a network whose arrays fit. Empty if there is none.
std::optional<std::string> damage_of(const HostNeural& field);

/// evaluate_vertex() by floats.
void evaluate_vertex_network(const float* weights, const float* inputs, float* outputs);

/// A back end may set `evaluate` of the view to a faster function with the same bits.
template <template <class> class Array, template <class> class FieldArray>
NeuralField field_view(const FieldShape& shape, const VolumeStorage<Array>& volumes,
                       NeuralStorage<FieldArray>& arrays) {
    NeuralField field;
    static_cast<TableField&>(field) = field_view(shape, volumes, static_cast<TableStorage<FieldArray>&>(arrays));
    field.evaluate = evaluate_vertex_network;
    field.weights = view_of(arrays.average);
    field.corner = shape.corner;
    field.edge = shape.edge;
    field.counts = view_of(arrays.counts);
    return field;
}

/// VolumeSummary: of the mixtures at the sites of volumes, beside the tables' numbers.
struct NeuralSummary : TableVolumeSummary {
    NeuralField mixtures;

    /// Of the mixture over as many cells of the hemisphere as tables have.
    float entropy(std::uint32_t volume) const;
};
static_assert(VolumeSummary<NeuralSummary>);

/// The mixture at the site of a volume.
VertexMixture mixture_of_volume(const NeuralField& field, std::uint32_t volume);
/// The density of `mixture` in direction `local`, in the frame of the volume's normal, divided by the density of cosine sampling.
float relative_density(const NeuralField& field, std::uint32_t volume, const VertexMixture& mixture, Vec3f local);

template <template <class> class Array>
NeuralSummary summary_of(const FieldShape& shape, const HostVolumes& volumes, NeuralStorage<Array>& field) {
    return {{update_view(shape, static_cast<TableStorage<Array>&>(field))}, field_view(shape, volumes, field)};
}

}  // namespace pl
