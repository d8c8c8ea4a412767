// The integrators of representations that run on the host alone: the same methods as in method_list.h, with other fields.
#pragma once

#include "core/kernel/guiding/lobe_field.h"
#include "core/kernel/guiding/sd_tree_field.h"
#include "core/kernel/methods/method_list.h"

namespace pl {

// One line each, counted by cmake/MethodList.cmake; a file of its own for each in the CPU back end.
// clang-format off
using HostMethodList = TypeList<
    MethodKernel<Precomputed, Guided<SdTreeField, FrozenField>>,
    MethodKernel<Reinforcement, Guided<SdTreeField, ExpectedSarsa>>,
    MethodKernel<Reinforcement, Guided<SdTreeField, Sarsa>>,
    MethodKernel<Reinforcement, Guided<SdTreeField, MonteCarlo>>,
    MethodKernel<Precomputed, Guided<LobeField, FrozenField>>,
    MethodKernel<Reinforcement, Guided<LobeField, ExpectedSarsa>>,
    MethodKernel<Reinforcement, Guided<LobeField, Sarsa>>,
    MethodKernel<Reinforcement, Guided<LobeField, MonteCarlo>>
>;
// clang-format on

/// The number of a method, by one of its entries in any list.
template <class Identity, int kEntry = 0>
constexpr MethodId id_of() {
    if constexpr (std::is_same_v<typename TypeAt<kEntry, MethodList>::Info, Identity>)
        return {method_index<kEntry>()};
    else
        return id_of<Identity, kEntry + 1>();
}

/// Calls visit.operator()<kEntry>() for the first entry of HostMethodList with a field of type F that serves a method and its settings.
template <class F, class Visit>
constexpr bool with_host_kernel(MethodId method, const LearningSettings& learning, bool samples_lights,
                                Visit&& visit) {
    return any_entry<HostMethodList>([&]<int kEntry>() {
        using Kernel = TypeAt<kEntry, HostMethodList>;
        if constexpr (std::is_same_v<typename Kernel::Integrator::Field, F>) {
            if (id_of<typename Kernel::Info>() != method || !Kernel::Integrator::serves(learning, samples_lights))
                return false;
            visit.template operator()<kEntry>();
            return true;
        } else {
            return false;
        }
    });
}

}  // namespace pl
