// The settings of a guiding field, and the sizes that follow from them.
#pragma once

#include <cstddef>

#include "core/fields/field_shape.h"
#include "core/fields/placement_storage.h"
#include "core/kernel/methods/learning_target.h"
#include "core/scene/scene_storage.h"

namespace pl {

/// refine_share: if the budget decides the number of volumes, up to 1, as training samples allow; 0 if the number is
/// given.
inline constexpr float kRefineByRecords = -1.0f;

struct FieldSettings {
    int volumes = 0;                 ///< 0: as many as the budget holds, at most kDefaultVolumes
    double budget_megabytes = 16.0;  ///< of 10^6 bytes: all memory of one method that grows with the volumes
    int bins = 256;                  ///< directions per volume, a square number from 4 to 1024
    LearningRate rate = LearningRate::Forgetful;
    LearningSettings learning{};
    float uniform_floor = kUniformShare;
    int precompute_samples = 1;  ///< probes per cell and volume, a square number
    /// Volumes that refinement may add, as a share of the volumes placed, in [0, 1]; or kRefineByRecords. See
    /// refine_placement().
    float refine_share = kRefineByRecords;
    Representation representation = Representation::Table;  ///< of methods that learn; probes fill tables

    friend bool operator==(const FieldSettings&, const FieldSettings&) = default;
};

/// More volumes learn more slowly from the same paths; the tables of about a thousand fit the second-level cache.
inline constexpr int kDefaultVolumes = 1000;

/// Most bytes of one volume: placement, tree, grid and tables. `light_clusters`, here and below: of the scene's light tree.
std::size_t bytes_per_volume(int bins, std::size_t light_clusters = 0);

/// Throws MemoryError if the volumes of the settings and what one method learns do not fit the memory that is left.
void require_field_memory(const FieldSettings& settings, std::size_t light_clusters);

/// Number of volumes of the settings, before surfaces too small for their share are given one volume each.
int volume_count(const FieldSettings& settings, std::size_t light_clusters = 0);

/// Most volumes after refinement of `placed` volumes: refine_share more, within the budget if that decides their
/// number.
std::size_t most_refined_volumes(const FieldSettings& settings, std::size_t placed, std::size_t light_clusters = 0);

/// The radiance unit is the smallest power of two not below the brightest emission.
FieldShape make_field_shape(const HostScene& scene, const FieldSettings& settings);

/// Bytes of placement, tree and grid.
std::size_t volume_bytes(const HostVolumes& volumes);

}  // namespace pl
