// The list of all methods. Both back ends, their build lists and launchers, the session and the window expand it: a method is
// its header, and its lines here.
#pragma once

#include "core/kernel/base/type_list.h"
#include "core/kernel/guiding/neural_vertex_field.h"
#include "core/kernel/guiding/table_field.h"
#include "core/kernel/methods/default.h"
#include "core/kernel/methods/precomputed.h"
#include "core/kernel/methods/reinforcement.h"

namespace pl {

/// An integrator of a method. A method with several, for its settings or for several representations of its field, has one
/// line for each, one after the other.
template <class Identity, Method M>
struct MethodKernel {
    using Info = Identity;
    using Integrator = M;
};

// One line each: cmake/MethodList.cmake counts them, and compiles each in a file of its own.
// clang-format off
using MethodList = TypeList<
    MethodKernel<Default, DefaultMethod>,
    MethodKernel<Precomputed, Guided<TableField, FrozenField>>,
    MethodKernel<Precomputed, Guided<NeuralVertexField, FrozenField>>,
    MethodKernel<Reinforcement, Guided<TableField, ExpectedSarsa>>,
    MethodKernel<Reinforcement, Guided<TableField, Sarsa>>,
    MethodKernel<Reinforcement, Guided<TableField, MonteCarlo>>,
    MethodKernel<Reinforcement, Guided<NeuralVertexField, ExpectedSarsa>>,
    MethodKernel<Reinforcement, Guided<NeuralVertexField, Sarsa>>,
    MethodKernel<Reinforcement, Guided<NeuralVertexField, MonteCarlo>>
>;
// clang-format on

/// Number of the method that an entry of the list belongs to.
template <int kEntry>
constexpr std::uint32_t method_index() {
    if constexpr (kEntry == 0) {
        return 0;
    } else {
        constexpr bool kSame =
            std::is_same_v<typename TypeAt<kEntry, MethodList>::Info, typename TypeAt<kEntry - 1, MethodList>::Info>;
        return method_index<kEntry - 1>() + (kSame ? 0u : 1u);
    }
}

inline constexpr int kMethodCount = static_cast<int>(method_index<MethodList::kCount - 1>()) + 1;

/// Calls visit.operator()<kEntry>() for the entries of the list in order until one returns true. Returns whether one
/// did.
template <class Visit>
constexpr bool any_method_kernel(Visit&& visit) {
    return any_entry<MethodList>(visit);
}

/// Whether an integrator samples from fields of type F, if from any.
template <class M, class F>
constexpr bool takes_field() {
    if constexpr (requires { typename M::Field; })
        return std::is_same_v<typename M::Field, F>;
    else
        return true;
}

/// Calls the same for the first entry that serves a method, its settings and a field of type F.
template <class F = TableField, class Visit>
constexpr bool with_method_kernel(MethodId method, const LearningSettings& learning, bool samples_lights,
                                  Visit&& visit) {
    return any_method_kernel([&]<int kEntry>() {
        using Integrator = typename TypeAt<kEntry, MethodList>::Integrator;
        if constexpr (takes_field<Integrator, F>()) {
            if (MethodId{method_index<kEntry>()} != method || !Integrator::serves(learning, samples_lights))
                return false;
            visit.template operator()<kEntry>();
            return true;
        } else {
            return false;
        }
    });
}

}  // namespace pl
