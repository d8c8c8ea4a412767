// All representations of a guiding field on the host: their list, and what back ends, session and files do with a field of any of them.
#pragma once

#include <array>
#include <utility>
#include <variant>

#include "core/fields/lobe_model.h"
#include "core/fields/neural_model.h"
#include "core/fields/sd_tree_model.h"
#include "core/kernel/base/type_list.h"
#include "core/kernel/methods/method.h"

namespace pl {

/// In the order in which users choose. A representation is its kernel model, its FieldModel, and its line here.
// clang-format off
using FieldModels = TypeList<
    TableModel,
    SdTreeModel,
    LobeModel,
    NeuralModel
>;
// clang-format on

template <class... Models>
constexpr auto infos_of(TypeList<Models...>) {
    return std::array{Models::kInfo...};
}
inline constexpr auto kRepresentations = infos_of(FieldModels{});

/// Calls visit.operator()<Model>() with the model of a representation, which is one of the list.
template <class Visit>
constexpr void with_model(Representation representation, Visit&& visit) {
    any_of_types(FieldModels{}, [&]<class Model>() {
        if (Model::kInfo.value != representation) return false;
        visit.template operator()<Model>();
        return true;
    });
}

/// Time that guiding takes at a vertex, over the time that guiding by a table takes.
constexpr double guidance_of(Representation representation) {
    double guidance = 1.0;
    with_model(representation, [&]<class Model>() { guidance = Model::kGuidance; });
    return guidance;
}

/// Whether tables of radiance volumes keep what is learned: then they are refined, and sampled or the teacher of what is.
constexpr bool has_tables(Representation representation) {
    bool has = false;
    with_model(representation, [&]<class Model>() { has = std::derived_from<typename Model::Field, TableField>; });
    return has;
}

template <template <class> class Array, class... Models>
std::variant<typename Models::template Storage<Array>...> any_arrays_of(TypeList<Models...>);
template <class... Models>
std::variant<std::monostate, typename Models::Field...> any_view_of(TypeList<Models...>);

/// The arrays of a field in memory of one kind, by representation.
template <template <class> class Array>
using FieldArrays = decltype(any_arrays_of<Array>(FieldModels{}));
using HostField = FieldArrays<LargeArray>;

/// A field as kernels see it; std::monostate for methods without one.
using AnyFieldView = decltype(any_view_of(FieldModels{}));

/// The representation of a field's arrays: their place in the variant.
template <FieldStorage... Storages>
Representation representation_of(const std::variant<Storages...>& field) {
    return kRepresentations[field.index()].value;
}
/// The representation of a view; the table without a field.
inline Representation representation_of(const AnyFieldView& field) {
    return field.index() == 0 ? Representation::Table : kRepresentations[field.index() - 1].value;
}

/// Arrays without values.
template <FieldStorage... Storages>
void clear_to(std::variant<Storages...>& field, Representation representation) {
    const auto clear = [&]<class Storage>() {
        if (ModelOf<Storage>::kInfo.value == representation) field.template emplace<Storage>();
    };
    (clear.template operator()<Storages>(), ...);
}

/// A field without training samples.
inline HostField make_field(const FieldShape& shape, std::size_t volumes, Representation representation) {
    HostField field;
    with_model(representation, [&]<class Model>() {
        field = make_arrays<typename Model::template Storage<LargeArray>>(shape, volumes);
    });
    return field;
}

inline bool fits(const FieldShape& shape, const HostField& field, std::size_t volumes) {
    return std::visit([&](const auto& arrays) { return fits(shape, arrays, volumes); }, field);
}
inline std::size_t field_bytes(const HostField& field) {
    return std::visit([](const auto& arrays) { return field_bytes(arrays); }, field);
}
inline FieldReport report_of(const HostField& field) {
    return std::visit([](const auto& arrays) { return report_of(arrays); }, field);
}
/// The report of a field of which it tells bytes alone, all of which volumes own; none of others.
inline std::optional<FieldReport> report_by_shape(const FieldShape& shape, std::size_t volumes,
                                                  Representation representation) {
    std::optional<FieldReport> report;
    with_model(representation, [&]<class Model>() {
        using Storage = typename Model::template Storage<LargeArray>;
        bool is_by_volume = true;
        for_each_array_of<Storage>([&](const auto& spec) {
            is_by_volume = is_by_volume && kIsByVolume<std::remove_cvref_t<decltype(spec)>>;
        });
        if (is_by_volume) report = FieldReport{.bytes = volumes * bytes_by_volume<Storage>(shape)};
    });
    return report;
}
/// Its directions in words: "256 directions".
inline std::string text_of(const FieldShape& shape, const HostField& field) {
    return std::visit([&](const auto& arrays) { return ModelOf<decltype(arrays)>::text(shape, arrays); }, field);
}

/// Calls fn(array of `from`, array of `to`) for every array, after `to` has got the representation of `from`.
template <FieldStorage... From, FieldStorage... To, class Fn>
void zip_fields(const std::variant<From...>& from, std::variant<To...>& to, Fn&& fn) {
    clear_to(to, representation_of(from));
    std::visit(
        [&](const auto& source, auto& target) {
            if constexpr (std::same_as<ModelOf<decltype(source)>, ModelOf<decltype(target)>>) zip(source, target, fn);
        },
        from, to);
}

/// The field of a refined placement: volume i of the new ones, behind the others, is split off parents[i].
inline HostField split_field(const FieldShape& shape, HostField field, std::span<const std::uint32_t> parents) {
    return std::visit(
        [&](auto&& arrays) -> HostField {
            return split_field(shape, std::forward<decltype(arrays)>(arrays), parents);
        },
        std::move(field));
}

/// One volume as make_field() makes it: it has learned nothing. `volume` is below volume_count().
inline void forget_volume(const FieldShape& shape, const HostVolumes& volumes, HostField& field, std::size_t volume) {
    std::visit([&](auto& arrays) { forget_volume(shape, volumes, arrays, volume); }, field);
}

/// Views for kernels that trace paths.
template <template <class> class Array, FieldStorage... Storages>
AnyFieldView field_view(const FieldShape& shape, const VolumeStorage<Array>& volumes,
                        std::variant<Storages...>& field) {
    return std::visit([&](auto& arrays) -> AnyFieldView { return field_view(shape, volumes, arrays); }, field);
}

/// Calls visit(view) with the view that `field`, an AnyFieldView, holds. Throws std::bad_variant_access if it holds none.
template <std::size_t kFirst = 1, class Any, class Visit>
decltype(auto) visit_field(Any& field, Visit&& visit) {
    if constexpr (kFirst + 1 < std::variant_size_v<std::remove_const_t<Any>>)
        if (field.index() != kFirst) return visit_field<kFirst + 1>(field, visit);
    return visit(std::get<kFirst>(field));
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
