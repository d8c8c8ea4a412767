// Sizing and placing the radiance volumes, and their empty tables.
#pragma once

#include <cstddef>
#include <functional>

#include "core/fields/field_storage.h"
#include "core/kernel/methods/learning_target.h"
#include "core/scene/scene_storage.h"

namespace pl {

/// A share of volumes that splitting may add: up to 1, as soon as there are records for them, where the budget decides about
/// the number of volumes; none where that is given.
inline constexpr float kRefineByRecords = -1.0f;

struct FieldSettings {
    int volumes = 0;                 ///< 0: as many as the budget holds, at most kDefaultVolumes
    double budget_megabytes = 16.0;  ///< of 10^6 bytes, all that grows with the volumes of one method
    int bins = 256;                  ///< directions per volume, a square number from 4 to 1024
    LearningRate rate = LearningRate::Forgetful;
    LearningSettings learning{};
    float uniform_floor = kUniformShare;
    int precompute_samples = 4;  ///< paths per cell and volume, a square number
    Lookup lookup = Lookup::Grid;
    /// Of the volumes placed, how many more splitting may add, in [0, 1], or kRefineByRecords; see refine_placement().
    float refine_share = kRefineByRecords;

    friend bool operator==(const FieldSettings&, const FieldSettings&) = default;
};

/// More volumes learn slower from the same paths; about a thousand fit the second-level cache.
inline constexpr int kDefaultVolumes = 1000;

/// Bytes that one volume takes in tables.
std::size_t table_bytes(int bins);

/// Bytes that one volume takes at most: placement, tree, grid and tables. The grid counts whichever lookup is chosen,
/// so that the number of volumes does not depend on it.
std::size_t bytes_per_volume(int bins);

/// Number of volumes that the settings ask for (before surfaces too small for their share get one of their own).
int volume_count(const FieldSettings& settings);

/// Most volumes that splitting may make of those that were placed: their share more, and no more than the budget holds
/// where it decides about their number.
std::size_t most_refined_volumes(const FieldSettings& settings, std::size_t placed);

/// Shape of the tables; the radiance unit is the smallest power of two not below the brightest emission.
FieldShape make_field_shape(const HostScene& scene, const FieldSettings& settings);

/// Places volumes on reflecting surfaces by systematic sampling of cumulative area with a Hammersley set, on every
/// side of a surface that light can reach. A surface is a connected set of triangles that face (nearly) the same way;
/// each side gets at least one volume unless there are more sides than volumes. Deterministic in the scene and the
/// settings; scaling the scene by a power of two scales the result.
HostVolumes place_volumes(const HostScene& scene, const FieldSettings& settings);

/// Points of the sides that place_volumes() puts volumes on: the same way of placing, with `density` times as many on each
/// side. Side by side.
void for_each_site(const HostScene& scene, const FieldSettings& settings, std::uint32_t density,
                   const std::function<void(const SurfacePoint&)>& visit);

/// Balanced tree over the sites, in the layout of KdTreeView. Sites with positions that are not finite are left out.
std::vector<KdNode> build_kd_tree(Span<const SurfacePoint> sites);

/// Tables of volumes that have learned nothing: uniform.
HostTables make_tables(const FieldShape& shape, std::size_t volumes);

/// Bytes of placement, tree and grid.
std::size_t volume_bytes(const HostVolumes& volumes);

/// Bytes of placement and tables.
std::size_t field_bytes(const HostVolumes& volumes, const HostTables& tables);

}  // namespace pl
