#include "core/scene/scene_hash.h"

#include <fmt/format.h>

#include "core/base/hash.h"

namespace pl {
namespace {

void add(Fnv1a& hash, const glm::vec3& v) {
    hash.add(v.x);
    hash.add(v.y);
    hash.add(v.z);
}

void add(Fnv1a& hash, const glm::uvec3& v) {
    hash.add(std::uint64_t{v.x});
    hash.add(std::uint64_t{v.y});
    hash.add(std::uint64_t{v.z});
}

}  // namespace

std::string scene_hash(const SceneDescription& scene) {
    Fnv1a hash;
    hash.add(std::uint64_t{scene.positions.size()});
    for (const glm::vec3& position : scene.positions) add(hash, position);
    hash.add(std::uint64_t{scene.normals.size()});
    for (const glm::vec3& normal : scene.normals) add(hash, normal);
    hash.add(std::uint64_t{scene.triangles.size()});
    for (const TriangleDescription& triangle : scene.triangles) {
        add(hash, triangle.vertex);
        add(hash, triangle.normal);
        hash.add(std::uint64_t{triangle.material});
    }
    hash.add(std::uint64_t{scene.materials.size()});
    for (const MaterialDescription& material : scene.materials) {
        add(hash, material.albedo);
        add(hash, material.emission);
        hash.add(std::uint64_t{material.two_sided_emission});
    }
    add(hash, scene.environment);
    return fmt::format("{:016x}", hash.value());
}

}  // namespace pl
