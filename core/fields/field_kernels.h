// Which entry of the list of methods serves a representation: asked by back ends, and by those who tell which kernel runs.
#pragma once

#include <type_traits>

#include "core/base/error.h"
#include "core/fields/field_model.h"
#include "core/kernel/methods/method_list.h"

namespace pl {

/// The representation whose kernels sample from a field; the table without a field.
inline Representation sampled_representation(const AnyFieldView& field) {
    if (std::holds_alternative<SdTreeField>(field)) return Representation::SdTree;
    if (std::holds_alternative<LobeField>(field)) return Representation::Lobes;
    if (std::holds_alternative<NeuralField>(field)) return Representation::Neural;
    return Representation::Table;
}

/// Calls visit.operator()<kEntry>() for the entry of MethodList that serves passes of a method with a representation, see
/// with_method_kernel(). Throws Error(Runtime) if there is none, see has_target().
template <class Visit>
void with_kernel_of(Representation representation, MethodId method, const LearningSettings& learning, bool trains,
                    Visit&& visit) {
    const auto is_found = [&]<class F>(std::type_identity<F>) {
        return with_method_kernel<F>(method, learning, trains, visit);
    };
    const auto any_of = [&] {
        switch (representation) {
        case Representation::SdTree: return is_found(std::type_identity<SdTreeField>{});
        case Representation::Lobes: return is_found(std::type_identity<LobeField>{});
        case Representation::Neural: return is_found(std::type_identity<NeuralField>{});
        case Representation::Table: break;
        }
        return is_found(std::type_identity<TableField>{});
    };
    if (!any_of()) throw Error(ErrorKind::Runtime, "this method has no kernels for these settings and this field");
}

}  // namespace pl
