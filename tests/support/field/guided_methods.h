// The methods guided by tables, by short names, and ready to sample.
#pragma once

#include "core/kernel/methods/method_list.h"

namespace pl::test {

using PrecomputedMethod = Guided<TableField, FrozenField>;
using ReinforcementMethod = Guided<TableField, ExpectedSarsa>;
using SarsaMethod = Guided<TableField, Sarsa>;
using MonteCarloMethod = Guided<TableField, MonteCarlo>;

/// The memory of a path with its store, which else belongs to the driver of the path.
template <Method M>
struct OwnMemory : M::Memory {
    OwnMemory() {
        if constexpr (requires { this->keep(&store); }) this->keep(&store);
    }
    OwnMemory(const OwnMemory&) = delete;
    OwnMemory& operator=(const OwnMemory&) = delete;

    typename M::Store store;
};

template <GuidedMethod M = ReinforcementMethod>
M guided_by(const TableField& field, const MixtureSettings& mixture = {}) {
    M method;
    method.field = field;
    method.mixture = mixture;
    return method;
}

/// The numbers by which the integrator scatters a path at its vertex `index`.
inline ScatterUniforms numbers_of(const Rng& rng, std::uint32_t index) {
    return {.rng = rng, .index = index, .u = rng.draw(index, Purpose::Scatter)};
}

}  // namespace pl::test
