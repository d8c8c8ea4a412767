// Placement of the radiance volumes on the surfaces of a scene.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/fields/field_settings.h"
#include "core/fields/surfaces.h"
#include "core/kernel/scene/camera.h"
#include "core/scene/scene_storage.h"

namespace pl {

/// Where volumes may be placed, and by which settings.
struct SiteSource {
    const HostScene& scene;
    const LitSurfaces& surfaces;  ///< of the scene
    const FieldSettings& settings;
    const Camera* camera = nullptr;  ///< null: all volumes by area
    int threads = 1;                 ///< change nothing but the time
};

/// Places volumes on reflecting surfaces by systematic sampling of cumulative area with a Hammersley set, on every
/// side of a surface that light reaches. A surface is a connected set of triangles with (nearly) the same normal;
/// each side gets at least one volume. Where there are more sides than volumes, area would leave out most of them: there half
/// of the volumes are placed where paths from the camera arrive, see choose_sites(); all by area without a camera.
/// Deterministic in the scene, the settings and the camera; scaling the scene by a power of two scales the result.
HostVolumes place_volumes(const SiteSource& source);
/// The same on surfaces that are found for it.
HostVolumes place_volumes(const HostScene& scene, const FieldSettings& settings, const Camera* camera = nullptr,
                          int threads = 1);

/// Visits points on the sides that carry volumes, placed as place_volumes() does, but with `density` times as many per side,
/// and of those by paths as many more as paths have arrived at.
void for_each_site(const SiteSource& source, std::uint32_t density,
                   const std::function<void(const SurfacePoint&)>& visit);

/// Balanced tree over the sites in the layout of KdTreeView, without sites whose position is not finite.
std::vector<KdNode> build_kd_tree(Span<const SurfacePoint> sites);
/// The same of nodes in any order, whose axes are set.
std::vector<KdNode> build_kd_tree(std::vector<KdNode> nodes);

/// Whether place_volumes() returns the same volumes for both scenes, which differ in materials alone. Conservative:
/// true only if every changed property is one that placement does not read, such as the color of a surface that stays
/// diffuse.
bool same_placement(const HostScene& before, const HostScene& after);

}  // namespace pl
