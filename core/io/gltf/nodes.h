// The nodes of a glTF file, with their places in the world.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "core/io/gltf/gltf_file.h"

namespace pl {

struct GltfNode {
    std::string name;
    glm::dmat4 to_world{1.0};
    std::optional<std::uint32_t> mesh{}, camera{}, skin{};
    std::optional<std::uint32_t> light{};  ///< of KHR_lights_punctual
};

struct GltfNodes {
    std::vector<GltfNode> all;
    std::vector<std::uint32_t> shown;  ///< those of the scene that the file shows, parents before their children
};

/// Scales, then turns, then moves. The quaternion has a length above 0.
glm::dmat4 transform_of(const glm::dvec3& move, const glm::dquat& turn, const glm::dvec3& scale);

/// Places are relative to `origin`. Throws Error(Input) for nodes with two parents or in a circle.
GltfNodes read_nodes(const GltfFile& file, const glm::dvec3& origin = glm::dvec3(0.0));

}  // namespace pl
