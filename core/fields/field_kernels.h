// Which kernels serve a representation: asked by back ends, and by those who tell which kernel runs or choose a back end.
#pragma once

#include "core/base/error.h"
#include "core/fields/field_model.h"
#include "core/kernel/methods/method_list.h"

namespace pl {

/// Whether an entry of MethodList samples from fields of this type.
template <class Field>
constexpr bool is_in_method_list() {
    return any_method_kernel([]<int kEntry>() {
        using Integrator = typename TypeAt<kEntry, MethodList>::Integrator;
        if constexpr (requires { typename Integrator::Field; })
            return std::same_as<typename Integrator::Field, Field>;
        else
            return false;
    });
}

/// The kernel of a representation that is not in MethodList: it learns by Expected Sarsa and runs on the host alone.
template <class Model>
constexpr auto host_kernel_of() {
    using Field = typename Model::Field;
    if constexpr (is_in_method_list<Field>())
        return TypeList<>{};
    else
        return TypeList<MethodKernel<Reinforcement, Guided<Field, ExpectedSarsa>, KernelRange::Sparse>>{};
}
template <class... Models>
constexpr auto host_kernels_of(TypeList<Models...>) {
    return (MethodList{} + ... + host_kernel_of<Models>());
}

/// All kernels of the host: the kernels of MethodList, by the same numbers, and the kernels that no device has.
using HostMethodList = decltype(host_kernels_of(FieldModels{}));

/// Whether devices have kernels for a representation, too.
constexpr bool is_for_devices(Representation representation) {
    bool is_there = false;
    with_model(representation, [&]<class Model>() { is_there = is_in_method_list<typename Model::Field>(); });
    return is_there;
}

/// Calls visit.operator()<kEntry>() for the entry of HostMethodList that serves passes of a method with a representation, see
/// with_method_kernel(). Returns whether there is one.
template <class Visit>
constexpr bool any_kernel_of(Representation representation, MethodId method, const LearningSettings& learning,
                             bool trains, Visit&& visit) {
    bool is_found = false;
    with_model(representation, [&]<class Model>() {
        is_found = with_method_kernel<typename Model::Field, HostMethodList>(method, learning, trains, visit);
    });
    return is_found;
}

/// As any_kernel_of(), but throws Error(Runtime) if there is no such kernel, see has_target().
template <class Visit>
void with_kernel_of(Representation representation, MethodId method, const LearningSettings& learning, bool trains,
                    Visit&& visit) {
    if (!any_kernel_of(representation, method, learning, trains, visit))
        throw Error(ErrorKind::Runtime, "this method has no kernels for these settings and this field");
}

/// Whether there are kernels that train a representation by a target.
constexpr bool has_target(Representation representation, LearningTarget target) {
    return any_kernel_of(representation, MethodId::Reinforcement, {.target = target}, true, []<int kEntry>() {});
}

}  // namespace pl
