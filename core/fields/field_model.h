// All representations of a guiding field on the host. Back ends, session and files speak HostField and AnyFieldView and call the
// functions below, each of which a representation overloads for its own arrays (table_model.h is the first). A representation is
// its kernel model (GuidingField), its storage with these overloads, one entry in each of the two lists, and its tests.
#pragma once

#include <utility>
#include <variant>

#include "core/fields/lobe_model.h"
#include "core/fields/neural_model.h"
#include "core/fields/sd_tree_model.h"
#include "core/kernel/methods/method.h"

namespace pl {

/// The arrays of a field in memory of one kind, by representation.
template <template <class> class Array>
using FieldArrays = std::variant<TableStorage<Array>, SdTreeStorage<Array>, LobeStorage<Array>, NeuralStorage<Array>>;
using HostField = FieldArrays<LargeArray>;

/// A field as kernels see it; std::monostate for methods without one.
using AnyFieldView = std::variant<std::monostate, TableField, SdTreeField, LobeField, NeuralField>;

/// The representation of a field's arrays: their place in the variant.
template <class Field>
Representation representation_of(const Field& field) {
    return kAllRepresentations[field.index()];
}

/// Arrays without values.
template <template <class> class Array>
void clear_to(FieldArrays<Array>& field, Representation representation) {
    switch (representation) {
    case Representation::Table: field = TableStorage<Array>{}; return;
    case Representation::SdTree: field = SdTreeStorage<Array>{}; return;
    case Representation::Lobes: field = LobeStorage<Array>{}; return;
    case Representation::Neural: field = NeuralStorage<Array>{}; return;
    }
}

/// A field without training samples.
inline HostField make_field(const FieldShape& shape, std::size_t volumes, Representation representation) {
    if (representation == Representation::SdTree) return make_sd_tree(shape, volumes);
    if (representation == Representation::Lobes) return make_lobes(shape, volumes);
    if (representation == Representation::Neural) return make_neural(shape, volumes);
    return make_tables(shape, volumes);
}

/// Whether all arrays have the length that follows from the shape and the number of volumes.
inline bool fits(const FieldShape& shape, const HostField& field, std::size_t volumes) {
    return std::visit([&](const auto& arrays) { return fits(shape, arrays, volumes); }, field);
}

inline std::size_t field_bytes(const HostField& field) {
    return std::visit([](const auto& arrays) { return field_bytes(arrays); }, field);
}

/// What is told of a field without its arrays.
struct FieldReport {
    std::size_t bytes = 0;                   ///< of its arrays
    std::optional<NetworkStatus> network{};  ///< of a neural field
};
inline FieldReport report_of(const HostField& field) {
    const auto* neural = std::get_if<HostNeural>(&field);
    return {.bytes = field_bytes(field),
            .network = neural != nullptr ? std::optional(status_of(*neural)) : std::nullopt};
}

/// Calls fn(array of `from`, array of `to`) for every array, after `to` has got the representation of `from`.
template <template <class> class From, template <class> class To, class Fn>
void zip_fields(const FieldArrays<From>& from, FieldArrays<To>& to, Fn&& fn) {
    clear_to(to, representation_of(from));
    if (const auto* tree = std::get_if<SdTreeStorage<From>>(&from))
        zip(*tree, std::get<SdTreeStorage<To>>(to), fn);
    else if (const auto* lobes = std::get_if<LobeStorage<From>>(&from))
        zip(*lobes, std::get<LobeStorage<To>>(to), fn);
    else if (const auto* neural = std::get_if<NeuralStorage<From>>(&from))
        zip(*neural, std::get<NeuralStorage<To>>(to), fn);
    else
        zip(std::get<TableStorage<From>>(from), std::get<TableStorage<To>>(to), fn);
}

/// The field of a refined placement: volume i of the new ones, behind the others, is split off parents[i].
inline HostField split_field(const FieldShape& shape, HostField field, std::span<const std::uint32_t> parents) {
    return std::visit(
        [&](auto&& arrays) -> HostField {
            return split_field(shape, std::forward<decltype(arrays)>(arrays), parents);
        },
        std::move(field));
}

/// Views for kernels that trace paths.
template <template <class> class Array, template <class> class FieldArray>
AnyFieldView field_view(const FieldShape& shape, const VolumeStorage<Array>& volumes,
                        FieldArrays<FieldArray>& field) {
    return std::visit([&](auto& arrays) -> AnyFieldView { return field_view(shape, volumes, arrays); }, field);
}

/// Calls visit(view) with the view that `field`, an AnyFieldView, holds. Throws std::bad_variant_access if it holds none.
template <class Any, class Visit>
decltype(auto) visit_field(Any& field, Visit&& visit) {
    if (auto* tree = std::get_if<SdTreeField>(&field)) return visit(*tree);
    if (auto* lobes = std::get_if<LobeField>(&field)) return visit(*lobes);
    if (auto* neural = std::get_if<NeuralField>(&field)) return visit(*neural);
    return visit(std::get<TableField>(field));
}

/// What a method is told that is constant during a pass.
struct MethodSettings {
    MixtureSettings mixture{};
    LearningSettings learning{};
    bool trains = true;  ///< whether a method that learns makes training samples
};

/// Sets the members of a method that are constant during a pass, as far as it has them.
template <Method M>
void configure_method(M& method, const AnyFieldView& field, const MethodSettings& settings) {
    if constexpr (requires { typename M::Field; }) {
        method.field = std::get<typename M::Field>(field);
        method.mixture = settings.mixture;
        method.trains = settings.trains;
    }
    if constexpr (requires { method.learning; }) method.learning = settings.learning;
}

/// The tables of a field that is represented by them. Throws std::bad_variant_access for others.
inline const HostTables& tables_of(const HostField& field) { return std::get<HostTables>(field); }
inline HostTables& tables_of(HostField& field) { return std::get<HostTables>(field); }
inline HostTables tables_of(HostField&& field) { return std::get<HostTables>(std::move(field)); }

}  // namespace pl
