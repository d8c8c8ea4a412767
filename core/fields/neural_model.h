// The neural field as a representation on the host: a network that is evaluated at every vertex, by whose mixtures kernels sample, and the
// tables that teach it.
#pragma once

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

/// Weight i of a network whose mixture is nearly the cosine everywhere: the last layer is 0, so that it changes nothing.
float first_network_weight(std::size_t i);

namespace network_arrays {

inline constexpr ArrayOwner kOfWeight{"place", [](const HostNeural&) { return kNetworkWeights; }};
inline constexpr ArrayOwner kOfCount{"place", [](const HostNeural&) { return std::size_t{kNetworkCounts}; }};

inline constexpr auto kFirstWeight = [](const FieldShape&, std::size_t i) { return first_network_weight(i); };
inline constexpr auto kFirstCount = [](const FieldShape&, std::size_t i) {
    return i == kNetworkVersion ? kNetworkLayoutVersion : 0;
};

using enum OnSplit;
using enum ValidRange;

// clang-format off
inline constexpr SpecList kAll{
    ArraySpec{"weights of the network", "weight", kOfWeight, Copy, Finite, kFirstWeight, [](auto& n) -> auto& { return n.weights; }},
    ArraySpec{"slopes of the network", "slope", kOfWeight, Copy, Finite, kZero, [](auto& n) -> auto& { return n.slope_mean; }},
    ArraySpec{"squares of slopes", "square of the slope", kOfWeight, Copy, Amount, kZero, [](auto& n) -> auto& { return n.slope_square; }},
    ArraySpec{"counts of the network", "count", kOfCount, Copy, Any, kFirstCount, [](auto& n) -> auto& { return n.counts; }},
    ArraySpec{"averages of weights", "average", kOfWeight, Copy, Finite, kFirstWeight, [](auto& n) -> auto& { return n.average; }},
};
// clang-format on
inline constexpr auto kWithTables = table_arrays::kAll + kAll;

}  // namespace network_arrays

/// Calls fn(spec) for every array of the network.
template <class Fn>
constexpr void for_each_network_array(Fn&& fn) {
    for_each_spec(network_arrays::kAll, fn);
}

/// Gives the network the weights of a fresh field and forgets its steps.
void reset_network(HostNeural& field);

/// Bytes of the network's arrays. The arrays of a volume have table_bytes().
inline constexpr std::size_t kNetworkBytes =
    4 * kNetworkWeights * sizeof(float) + kNetworkCounts * sizeof(std::uint32_t);

/// evaluate_vertex() by floats.
void evaluate_vertex_network(const float* weights, const float* inputs, float* outputs);

/// The mixture at the site of a volume.
VertexMixture mixture_of_volume(const NeuralField& field, std::uint32_t volume);
/// The density of `mixture` in direction `local`, in the frame of the volume's normal, divided by the density of cosine sampling.
float relative_density(const NeuralField& field, std::uint32_t volume, const VertexMixture& mixture, Vec3f local);

/// VolumeSummary: of the mixtures at the sites of volumes, beside the tables' numbers.
struct NeuralSummary : TableVolumeSummary {
    NeuralField mixtures;

    /// Of the mixture over as many cells of the hemisphere as tables have.
    float entropy(std::uint32_t volume) const;
};

/// The mixtures at the sites of volumes, by the cells of their tables, whose radiance and samples they are taught by.
struct NeuralInspector : TableInspector {
    NeuralField mixtures;

    float probability(std::uint32_t volume, int cell) const;
    float density(std::uint32_t volume, Vec2f square) const;

private:
    /// Kept for the next direction: the network is asked once for a volume.
    const VertexMixture& mixture_of(std::uint32_t volume) const;
    mutable VertexMixture mixture_{};
    mutable std::optional<std::uint32_t> mixture_volume_;
};

struct NeuralModel {
    using Field = NeuralField;
    template <template <class> class Array>
    using Storage = NeuralStorage<Array>;

    static constexpr ChoiceInfo<Representation> kInfo{.value = Representation::Neural,
                                                      .name = "neural",
                                                      .label = "Neural",
                                                      .sentence =
                                                          "a network that gives each vertex a mixture of lobes"};
    static constexpr double kGuidance = 13.0;
    static constexpr const auto& kArrays = network_arrays::kWithTables;
    static constexpr std::size_t kBytesBesideVolumes = kNetworkBytes;

    /// A back end may set `evaluate` of the view to a faster function with the same bits.
    template <template <class> class Array, template <class> class FieldArray>
    static NeuralField view(const FieldShape& shape, const VolumeStorage<Array>& volumes,
                            NeuralStorage<FieldArray>& arrays) {
        NeuralField field;
        static_cast<TableField&>(field) =
            TableModel::view(shape, volumes, static_cast<TableStorage<FieldArray>&>(arrays));
        field.evaluate = evaluate_vertex_network;
        field.weights = view_of(arrays.average);
        field.corner = shape.corner;
        field.edge = shape.edge;
        field.counts = view_of(arrays.counts);
        return field;
    }
    template <template <class> class Array>
    static NeuralSummary summary(const FieldShape& shape, const HostVolumes& volumes, NeuralStorage<Array>& arrays) {
        return {{update_view(shape, static_cast<TableStorage<Array>&>(arrays))}, view(shape, volumes, arrays)};
    }
    static NeuralInspector inspector(const NeuralField& field);
    static std::string text(const FieldShape&, const HostNeural& field);

    /// Divides the tables. The network, a function of the place, stays, as it does where a volume is forgotten.
    static HostNeural split(const FieldShape& shape, HostNeural field, std::span<const std::uint32_t> parents);
    static std::optional<FieldDamage> damage(const HostNeural& field);
    static NetworkStatus network(const HostNeural& field);
};
template <template <class> class Array>
NeuralModel model_of(const NeuralStorage<Array>&);
static_assert(FieldModel<NeuralModel>);

}  // namespace pl
