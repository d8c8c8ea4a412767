// Lists of types, for code that is compiled once per entry; members that only some instances of a template have.
#pragma once

#include <type_traits>
#include <utility>

#include "core/kernel/base/platform.h"

namespace pl {

/// In the place of a T that is not there: made of its arguments, and empty. Several of one T in an object need different tags: objects of
/// one type have addresses of their own, even if they are empty.
template <class T, int kTag>
struct Absent {
    constexpr Absent() = default;
    template <class... Arguments>
    PL_HD constexpr Absent(const Arguments&...) {}
};

/// The type of a member that is there in some instances of a template alone.
template <bool kIsThere, class T, int kTag = 0>
using MemberIf = std::conditional_t<kIsThere, T, Absent<T, kTag>>;

template <class... Types>
struct TypeList {
    static constexpr int kCount = static_cast<int>(sizeof...(Types));
};

template <class... A, class... B>
constexpr TypeList<A..., B...> operator+(TypeList<A...>, TypeList<B...>) {
    return {};
}

/// The type of one entry.
template <int kIndex, class List>
struct TypeAtIndex;
template <int kIndex, class First, class... Rest>
struct TypeAtIndex<kIndex, TypeList<First, Rest...>> : TypeAtIndex<kIndex - 1, TypeList<Rest...>> {};
template <class First, class... Rest>
struct TypeAtIndex<0, TypeList<First, Rest...>> {
    using Type = First;
};
template <int kIndex, class List>
using TypeAt = typename TypeAtIndex<kIndex, List>::Type;

/// Calls visit.operator()<Type>() for every entry in order, until one returns true. Returns whether one did.
template <class Visit, class... Types>
constexpr bool any_of_types(TypeList<Types...>, Visit&& visit) {
    return (visit.template operator()<Types>() || ...);
}

/// Calls visit.operator()<kIndex>() for the index of every entry in order, until one returns true. Returns whether one did.
template <class List, class Visit>
constexpr bool any_entry(Visit&& visit) {
    return [&]<int... kIndex>(std::integer_sequence<int, kIndex...>) {
        return (visit.template operator()<kIndex>() || ...);
    }
    (std::make_integer_sequence<int, List::kCount>{});
}

}  // namespace pl
