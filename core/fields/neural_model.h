// A neural field: tables, which kernels sample, and one network over all volumes that predicts the light in their cells. The one
// description of the network's arrays, and all code derived from it; the tables' are in table_model.h.
#pragma once

#include <optional>
#include <string>

#include "core/fields/table_model.h"
#include "core/kernel/guiding/network_layout.h"

namespace pl {

/// The tables keep the learned radiance. The network is taught by them in every update, and its predictions are the prior of the
/// probabilities by which they are sampled: see cpu/neural_update.h.
template <template <class> class Array>
struct NeuralStorage : TableStorage<Array> {
    Array<float> weights;         ///< of grids and layers, see NetworkLayout
    Array<float> slope_mean;      ///< of Adam: running mean of the slope of each weight
    Array<float> slope_square;    ///< and of its square
    Array<std::uint32_t> counts;  ///< by NetworkCount
};
using HostNeural = NeuralStorage<LargeArray>;

/// State of a network, as a session tells it.
struct NetworkStatus {
    std::size_t bytes = 0;    ///< of weights and the state of gradient descent
    std::uint64_t steps = 0;  ///< of gradient descent
    bool is_lost = false;     ///< see kNetworkIsLost
};

/// Description of one array of a network.
template <class Get>
struct NetworkSpec {
    const char* name;    ///< plural, in messages
    const char* single;  ///< of one value, in messages
    ValidRange valid;
    Get get;  ///< the array of any NeuralStorage
};
template <class Get>
NetworkSpec(const char*, const char*, ValidRange, Get) -> NetworkSpec<Get>;

namespace network_arrays {

using enum ValidRange;

/// The arrays in the order of files, behind those of the tables.
// clang-format off
inline constexpr std::tuple kAll{
    NetworkSpec{"weights of the network", "weight", Finite, [](auto& n) -> auto& { return n.weights; }},
    NetworkSpec{"slopes of the network", "slope", Finite, [](auto& n) -> auto& { return n.slope_mean; }},
    NetworkSpec{"squares of slopes", "square of the slope", Amount, [](auto& n) -> auto& { return n.slope_square; }},
    NetworkSpec{"counts of the network", "count", Any, [](auto& n) -> auto& { return n.counts; }},
};
// clang-format on

}  // namespace network_arrays

/// Calls fn(spec) for every array of the network.
template <class Fn>
constexpr void for_each_network_array(Fn&& fn) {
    std::apply([&](const auto&... spec) { (fn(spec), ...); }, network_arrays::kAll);
}

/// Calls fn(array of `from`, array of `to`) for every array; `to` is const if fn only reads it.
template <template <class> class From, class To, class Fn>
void zip(const NeuralStorage<From>& from, To& to, Fn&& fn) {
    for_each_table_array([&](const auto& spec) { fn(spec.get(from), spec.get(to)); });
    for_each_network_array([&](const auto& spec) { fn(spec.get(from), spec.get(to)); });
}

/// Uniform tables and a network that predicts the same light in all cells.
HostNeural make_neural(const FieldShape& shape, std::size_t volumes);

/// The network over volumes, whose outputs are the cells of a table.
NetworkLayout layout_of(const FieldShape& shape);

/// Gives the network its first weights and forgets its steps.
void reset_network(const NetworkLayout& layout, HostNeural& field);

/// Whether all arrays have the length that follows from the shape and the number of volumes.
bool fits(const FieldShape& shape, const HostNeural& field, std::size_t volumes);

/// Bytes of the network's arrays, for tables of so many cells. Those of a volume are table_bytes().
std::size_t network_bytes(int bins);
std::size_t field_bytes(const HostNeural& field);

NetworkStatus status_of(const HostNeural& field);

/// Divides the tables as split_field() of HostTables does. The network, a function of the place, stays.
HostNeural split_field(const FieldShape& shape, HostNeural field, std::span<const std::uint32_t> parents);

/// The damage of counts of a network whose arrays fit. Empty if there is none.
std::optional<std::string> damage_of(const HostNeural& field);

}  // namespace pl
