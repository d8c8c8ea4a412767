// Which entry of the lists of methods serves a representation: asked by back ends, and by those who tell which kernel runs.
#pragma once

#include "core/fields/field_model.h"
#include "core/kernel/methods/host_method_list.h"

namespace pl {

/// The representation whose kernels sample from a field; the table without a field, and for a prior of tables.
inline Representation sampled_representation(const AnyFieldView& field) {
    if (std::holds_alternative<SdTreeField>(field)) return Representation::SdTree;
    if (std::holds_alternative<LobeField>(field)) return Representation::Lobes;
    if (std::holds_alternative<NeuralVertexField>(field)) return Representation::NeuralVertex;
    return Representation::Table;
}

/// Calls visit.operator()<kEntry>() for the entry of MethodList, or visit_host.operator()<kEntry>() for that of HostMethodList, that serves
/// a method with a representation and settings. Returns whether there is one.
template <class Visit, class VisitHost>
bool with_kernel_of(Representation representation, MethodId method, const LearningSettings& learning,
                    bool samples_lights, Visit&& visit, VisitHost&& visit_host) {
    // Methods without a field are in MethodList alone, whatever the representation.
    if (representation == Representation::SdTree &&
        with_host_kernel<SdTreeField>(method, learning, samples_lights, visit_host))
        return true;
    if (representation == Representation::Lobes &&
        with_host_kernel<LobeField>(method, learning, samples_lights, visit_host))
        return true;
    if (representation == Representation::NeuralVertex)
        return with_method_kernel<NeuralVertexField>(method, learning, samples_lights, visit);
    return with_method_kernel(method, learning, samples_lights, visit);
}

}  // namespace pl
