// Names of surface kinds, and of other choices of materials, in files.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "core/kernel/shading/surface_lobes.h"

namespace pl {

/// [SurfaceKind]
inline constexpr std::array<std::string_view, 5> kSurfaceNames = {"diffuse", "conductor", "dielectric", "plastic",
                                                                  "pane"};

/// [NormalGreen]
inline constexpr std::array<std::string_view, 3> kNormalGreenNames = {"up", "down", "left"};

/// [OpacityRule]
inline constexpr std::array<std::string_view, 2> kOpacityRuleNames = {"threshold", "blend"};

inline std::optional<SurfaceKind> surface_kind(std::string_view name) {
    for (std::size_t i = 0; i < kSurfaceNames.size(); ++i) {
        if (kSurfaceNames[i] == name) {
            return static_cast<SurfaceKind>(i);
        }
    }
    return std::nullopt;
}

}  // namespace pl
