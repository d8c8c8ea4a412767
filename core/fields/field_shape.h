// The size and meaning of a field's arrays: shared by all representations.
#pragma once

#include "core/kernel/guiding/direction_cells.h"
#include "core/kernel/guiding/table_update.h"
#include "core/kernel/guiding/volume_lookup.h"

namespace pl {

struct FieldShape {
    DirectionCells cells;
    std::uint32_t light_clusters = 0;  ///< of the scene's light tree; 0: no tree
    float radiance_unit = 1.0f;        ///< of fixed-point sums: a power of two not below the brightest emission
    float extent = 0.0f;               ///< diagonal of the scene's bounds
    LearningRate rate = LearningRate::Forgetful;
    float uniform_floor = kUniformShare;
    Lookup lookup = Lookup::Grid;
};

}  // namespace pl
