// The two readings of MTL materials with both a color and an image.
#pragma once

namespace pl {

enum class MapKd {
    Multiplies,  ///< `map_Kd` times `Kd`, by the text of the format
    Replaces     ///< `map_Kd` alone, as Blender reads it
};

}  // namespace pl
