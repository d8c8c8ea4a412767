// Names of surface kinds, and of other choices of materials, in files.
#pragma once

#include <array>
#include <string_view>

#include "core/base/choice.h"
#include "core/kernel/shading/surface_lobes.h"

namespace pl {

template <>
inline constexpr auto kChoices<SurfaceKind> = std::to_array<ChoiceInfo<SurfaceKind>>({
    {SurfaceKind::Diffuse, "diffuse", "Diffuse"},
    {SurfaceKind::Conductor, "conductor", "Metal"},
    {SurfaceKind::Dielectric, "dielectric", "Glass"},
    {SurfaceKind::Plastic, "plastic", "Coated"},
    {SurfaceKind::Pane, "pane", "Thin pane"},
});

/// [NormalGreen]
inline constexpr std::array<std::string_view, 3> kNormalGreenNames = {"up", "down", "left"};

/// [OpacityRule]
inline constexpr std::array<std::string_view, 2> kOpacityRuleNames = {"threshold", "blend"};

}  // namespace pl
