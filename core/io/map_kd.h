// The two readings of MTL materials with both a color and an image.
#pragma once

#include <array>

#include "core/base/choice.h"

namespace pl {

enum class MapKd { Multiplies, Replaces };

template <>
inline constexpr auto kChoices<MapKd> = std::to_array<ChoiceInfo<MapKd>>({
    {MapKd::Multiplies, "multiply", "Multiply", "map_Kd times Kd, by the text of the format"},
    {MapKd::Replaces, "replace", "Replace", "map_Kd alone, as Blender reads it"},
});

}  // namespace pl
