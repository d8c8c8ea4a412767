// A method in the user interface: one MethodInfo in the header of each method.
#pragma once

#include <concepts>
#include <cstdint>
#include <string_view>

namespace pl {

/// The number of a method in the list of all (method_list.h). The constants name the methods of this project for tests and
/// front ends; a method needs none.
struct MethodId {
    std::uint32_t index = 0;

    static const MethodId Default, Precomputed, Reinforcement;

    template <std::integral T>
    constexpr explicit operator T() const {
        return static_cast<T>(index);
    }
    friend constexpr bool operator==(MethodId, MethodId) = default;
    friend constexpr bool operator<(MethodId a, MethodId b) { return a.index < b.index; }
};
inline constexpr MethodId MethodId::Default{0};
inline constexpr MethodId MethodId::Precomputed{1};
inline constexpr MethodId MethodId::Reinforcement{2};

struct MethodInfo {
    std::string_view name;     ///< on the command line and in files
    std::string_view label;    ///< on screen
    std::string_view summary;  ///< one sentence
    char key = 0;              ///< in the window
    std::uint32_t color = 0;   ///< of its curves, opaque ARGB
    bool uses_field = false;   ///< samples directions from a guiding field
    bool precomputes = false;  ///< fills its field by probes before it renders
    bool learns = false;       ///< trains its field while it renders
    MethodId id{};             ///< set by all_methods()
};

}  // namespace pl
