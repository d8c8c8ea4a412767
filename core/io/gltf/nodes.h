// The nodes of a glTF file, and the cameras and lights at them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "core/io/gltf/gltf_file.h"
#include "core/scene/description.h"

namespace pl {

// The nodes of a glTF file, with their places in the world.

struct GltfNode {
    std::string name;
    glm::dmat4 to_world{1.0};
    std::optional<std::uint32_t> mesh{}, camera{}, skin{};
    std::optional<std::uint32_t> light{};  ///< of KHR_lights_punctual
};

struct GltfNodes {
    std::vector<GltfNode> all;
    std::vector<std::uint32_t> shown;  ///< of the scene that the file shows, parents before their children
};

/// Scales, then turns, then moves. The quaternion has a length above 0.
glm::dmat4 transform_of(const glm::dvec3& move, const glm::dquat& turn, const glm::dvec3& scale);

/// Places are relative to `origin`. Throws Error(Input) for nodes with two parents or in a circle.
GltfNodes read_nodes(const GltfFile& file, const glm::dvec3& origin = glm::dvec3(0.0));

// Cameras of a glTF file.

/// Lists the perspective cameras of shown nodes in SceneDescription::cameras, under the names of their nodes. Expects the
/// triangles of the scene.
void add_gltf_cameras(GltfFile& file, const GltfNodes& nodes, SceneDescription& scene);

// Lights of a glTF file that no surface emits. [KHR_lights_punctual]

/// The lights of shown nodes. Candela count as W/sr and lux as W/m^2, as the radiance of emissive surfaces does; files of Blender's
/// exporter give light in lumens, 683 to a watt. Ranges are noted: the light of points and spots has none.
void add_gltf_lights(GltfFile& file, const GltfNodes& nodes, SceneDescription& scene);

}  // namespace pl
