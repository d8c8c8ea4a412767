// The size and meaning of a field's arrays: shared by all representations.
#pragma once

#include <cstdint>

#include "core/kernel/guiding/direction_cells.h"
#include "core/kernel/guiding/table_update.h"
#include "core/kernel/guiding/volume_lookup.h"
#include "core/kernel/methods/learning_target.h"

namespace pl {

/// How a method that learns represents incident radiance. Files store these numbers, which are the numbers of the
/// models (FieldModel); the constants name the models of this project for tests and front ends.
enum class Representation : std::uint32_t {
    Table,   ///< a table of cells per radiance volume
    SdTree,  ///< quadtrees over directions at the leaves of a binary tree over space   [Mueller et al. 2017]
    Lobes,   ///< a mixture of von Mises-Fisher lobes per radiance volume   [Ruppert et al. 2020]
    /// A network that gives every vertex its mixture of lobes, taught by tables   [Dong et al. 2023]. 3 was another one.
    Neural = 4,
};

struct FieldShape {
    DirectionCells cells;
    std::uint32_t light_clusters = 0;  ///< of the scene's light tree; 0: no tree
    float radiance_unit = 1.0f;        ///< of fixed-point sums: a power of two not below the brightest emission
    float extent = 0.0f;               ///< diagonal of the scene's bounds
    LearningRate rate = LearningRate::Forgetful;
    float uniform_floor = kUniformShare;
    Representation representation = Representation::Table;
    // Of an SD-tree:
    Vec3f corner{0.0f};            ///< lowest corner of the cube that it divides
    float edge = 1.0f;             ///< of the cube, above 0
    std::uint32_t most_nodes = 1;  ///< of all quadtrees
};

}  // namespace pl
