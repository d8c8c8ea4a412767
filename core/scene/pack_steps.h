// The steps of pack_scene(), in their order: each packs a part of a valid scene for the kernels.
#pragma once

#include "core/scene/description.h"
#include "core/scene/scene_storage.h"

namespace pl {

/// Packs all that depends on corners and normals alone: triangles, planes, normals, and the hierarchy.
void pack_geometry(const SceneDescription& scene, HostScene& packed);

/// Packs the opacities and images of the materials in use and the texture coordinates of all triangles, (0, 0) where they have
/// none. All arrays stay empty if no material in use has an image or holes. Images without effect are omitted: opacity of opaque
/// surfaces, images that multiply 0. Material::emission is multiplied by the mean of its image, so that
/// lights are sampled by it. Expects packed materials.
void pack_textures(const SceneDescription& scene, HostScene& packed);

/// Packs the environment map, unless it is black, with its cumulative probabilities, and the sun. Map and sun are sampled in
/// proportion to their irradiance; far lights and emissive triangles in proportion to their power, at least a tenth
/// of the samples each, with pi r^2 of the scene's bounding sphere as the receiving area of the far lights.
/// Expects packed triangles and lights. Divides SceneView::light_power by the probability of sampling `lights`, so
/// that the densities of lights include it. Returns the power of the far lights, divided by pi.
double pack_far_lights(const SceneDescription& scene, HostScene& packed);

/// Packs the lights without extent. These and all other lights are sampled in proportion to their power, at least a
/// tenth of the samples each. `far_power`: of pack_far_lights(), which must have run. Scales the probabilities of the
/// other lights.
void pack_delta_lights(const SceneDescription& scene, double far_power, HostScene& packed);

/// Bound on the edges of all triangles of instances; `triangles`: of the scene, packed. 0 without instances.
double longest_instance_edge(const SceneDescription& scene, Span<const Triangle> triangles);

/// Packs transformations, and the hierarchies of meshes and of instances. Expects packed triangles.
void pack_instances(const SceneDescription& scene, HostScene& packed);

/// Up to this number of emissive triangles, sampling by power alone is more efficient than a tree.
inline constexpr std::size_t kFewLights = 32;

/// Packs the light tree of core/kernel/shading/light_tree.h. Expects packed triangles, materials, lights and far lights. Up to kFewLights lights give an empty tree.
void pack_light_tree(HostScene& packed);

}  // namespace pl
