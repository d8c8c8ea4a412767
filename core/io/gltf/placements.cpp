#include "core/io/gltf/placements.h"

#include <fmt/format.h>

#include "core/io/gltf/accessors.h"
#include "core/io/kept_meshes.h"

namespace pl {
namespace {

glm::dvec3 vector_at(const std::vector<float>& values, std::uint64_t i, double standard) {
    if (values.empty()) return glm::dvec3(standard);
    return glm::dvec3(glm::vec3(values[3 * i], values[3 * i + 1], values[3 * i + 2]));
}

glm::dquat quaternion_at(const std::vector<float>& values, std::uint64_t i) {
    if (values.empty()) return {1.0, 0.0, 0.0, 0.0};
    const glm::dvec4 v(glm::vec4(values[4 * i], values[4 * i + 1], values[4 * i + 2], values[4 * i + 3]));
    return {v.w, v.x, v.y, v.z};
}

}  // namespace

std::string gpu_instancing_at(std::uint32_t node) {
    return fmt::format("/nodes/{}/extensions/EXT_mesh_gpu_instancing", node);
}

GltfPlacements::GltfPlacements(GltfFile& file, std::uint32_t number, const GltfNode& node)
    : node_to_world_(node.to_world) {
    const std::string at = gpu_instancing_at(number);
    if (!file.json().has(at)) return;
    if (node.skin) {
        file.note("instances of meshes with skins are left out", at);
        return;
    }
    const std::string attributes = at + "/attributes";
    count_ = 0;
    moves_ = read(file, attributes + "/TRANSLATION", "VEC3");
    turns_ = read(file, attributes + "/ROTATION", "VEC4");
    scales_ = read(file, attributes + "/SCALE", "VEC3");
    if (count_ == 0) count_ = 1;
    for (std::uint64_t i = 0; i < count_; ++i) {
        if (!(glm::length(quaternion_at(turns_, i)) > 0.0)) {
            file.fail(attributes + "/ROTATION",
                      fmt::format("expected unit quaternions, got one of no length at instance {}", i));
        }
    }
}

glm::dmat4 GltfPlacements::to_world(std::uint64_t i) const {
    if (moves_.empty() && turns_.empty() && scales_.empty()) return node_to_world_;
    return node_to_world_ *
           transform_of(vector_at(moves_, i, 0.0), quaternion_at(turns_, i), vector_at(scales_, i, 1.0));
}

/// An attribute, which sets or has the number of places; nothing if there is none.
std::vector<float> GltfPlacements::read(GltfFile& file, const std::string& at, const char* type) {
    const std::optional<std::uint32_t> accessor = file.index(at, "accessors");
    if (!accessor) return {};
    const std::uint64_t count = accessor_count(file, *accessor);
    if (count > kMostInstances)
        file.fail(at, fmt::format("expected at most {} instances, got {}", kMostInstances, count));
    if (count_ != 0 && count != count_)
        file.fail(at, fmt::format("expected an element for each of {} instances, got {}", count_, count));
    count_ = count;
    return read_floats(file, *accessor, type);
}

}  // namespace pl
