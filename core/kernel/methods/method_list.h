// The list of all methods, and of their kernels on both back ends, whose build lists and launchers expand it, as do the session and the
// window: a method is its header, and its lines here.
#pragma once

#include "core/kernel/base/type_list.h"
#include "core/kernel/guiding/neural_field.h"
#include "core/kernel/guiding/table_field.h"
#include "core/kernel/methods/default.h"
#include "core/kernel/methods/precomputed.h"
#include "core/kernel/methods/reinforcement.h"

namespace pl {

/// An integrator of a method, and the sets of effects that it is compiled for. A method with several, for its settings or for several
/// representations of its field, has one line for each, one after the other.
template <class Identity, Method M, KernelRange range = KernelRange::Full>
struct MethodKernel {
    using Info = Identity;
    using Integrator = M;
    static constexpr KernelRange kRange = range;
};

// One line each: cuda/CMakeLists.txt counts them and compiles each in a file of its own. The host has a kernel besides for each
// representation that devices do not have, see core/fields/field_kernels.h. Only tables have other targets than the
// target of Expected Sarsa, and kernels for fields that stay constant: a field of another kind stays constant by
// FieldTrainer::trains.
// clang-format off
using MethodList = TypeList<
    MethodKernel<Default, DefaultMethod>,
    MethodKernel<Precomputed, Guided<TableField, FrozenField>>,
    MethodKernel<Reinforcement, Guided<TableField, ExpectedSarsa>>,
    MethodKernel<Reinforcement, Guided<TableField, Sarsa>, KernelRange::Sparse>,
    MethodKernel<Reinforcement, Guided<TableField, MonteCarlo>, KernelRange::Sparse>,
    MethodKernel<Reinforcement, Guided<NeuralField, ExpectedSarsa>, KernelRange::Sparse>
>;
// clang-format on

/// Number of the method that an entry of the list belongs to.
template <int kEntry, class List = MethodList>
constexpr std::uint32_t method_index() {
    if constexpr (kEntry == 0) {
        return 0;
    } else {
        constexpr bool kSame =
            std::is_same_v<typename TypeAt<kEntry, List>::Info, typename TypeAt<kEntry - 1, List>::Info>;
        return method_index<kEntry - 1, List>() + (kSame ? 0u : 1u);
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

/// Whether a method trains its field while it renders.
constexpr bool is_learning(MethodId method) {
    return any_method_kernel([&]<int kEntry>() {
        return MethodId{method_index<kEntry>()} == method && TypeAt<kEntry, MethodList>::Info::kInfo.learns;
    });
}

/// Calls visit.operator()<kEntry>() for the entry of a list that serves passes of a method with a field of type F. Passes of a method that learns
/// may train nothing: they run an integrator whose field stays constant, if F has one. Returns whether there is an entry.
template <class F, class List = MethodList, class Visit>
constexpr bool with_method_kernel(MethodId method, const LearningSettings& learning, bool trains, Visit&& visit) {
    const bool is_constant = !trains && is_learning(method);
    return any_entry<List>([&]<int kEntry>() {
        using Integrator = typename TypeAt<kEntry, List>::Integrator;
        if constexpr (takes_field<Integrator, F>()) {
            const bool is_own = MethodId{method_index<kEntry, List>()} == method && Integrator::serves(learning);
            if (!is_own && !(is_constant && Integrator::kIsConstant)) return false;
            visit.template operator()<kEntry>();
            return true;
        } else {
            return false;
        }
    });
}

}  // namespace pl
