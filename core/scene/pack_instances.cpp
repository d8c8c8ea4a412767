#include "core/scene/pack_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/scene/affine.h"
#include "core/scene/build_bvh.h"
#include "core/scene/instance_boxes.h"
#include "core/scene/instances.h"
#include "core/scene/triangle_planes.h"

namespace pl {
namespace {

constexpr double kUnit = kRoundoff;

Span<const Triangle> triangles_of(const MeshDescription& mesh, Span<const Triangle> triangles) {
    return {triangles.data + mesh.first_triangle, mesh.triangle_count};
}

double largest(const Vec3d& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }
/// Sums of the magnitudes in the rows: |m| v for v = (1, 1, 1).
Vec3d row_sums(const glm::dmat3& m, const Vec3d& v = Vec3d{1.0}) {
    Vec3d sums{0.0};
    for (int column = 0; column < 3; ++column) sums += glm::abs(m[column]) * v[column];
    return sums;
}

/// The nearest floats outside.
Bounds rounded_outwards(const Vec3d& low, const Vec3d& high) {
    const auto away = [](double x, float towards) { return std::nextafter(static_cast<float>(x), towards); };
    Bounds bounds;
    for (int axis = 0; axis < 3; ++axis) {
        bounds.low[axis] = away(low[axis], -kInfinity);
        bounds.high[axis] = away(high[axis], kInfinity);
    }
    return bounds;
}

/// Writes the hierarchies of meshes one behind the other, as one array whose references count from its start.
class MeshPacker {
public:
    explicit MeshPacker(HostScene& packed) : packed_(packed) {}

    /// Returns the node of the root.
    std::uint32_t add(const MeshDescription& mesh) {
        const Span<const Triangle> triangles = triangles_of(mesh, view_of(std::as_const(packed_.triangles)));
        const Bvh bvh = build_bvh(view_of(std::as_const(packed_.positions)), triangles);
        const auto first_node = static_cast<std::uint32_t>(packed_.mesh_nodes.size());
        const auto first_triangle = static_cast<std::uint32_t>(packed_.mesh_triangles.size());
        for (BvhNode node : bvh.nodes) {
            node.first += node.count == 0 ? first_node : first_triangle;
            packed_.mesh_nodes.push_back(node);
        }
        for (const std::uint32_t primitive : bvh.primitives) {
            const Triangle& t = triangles[primitive];
            packed_.mesh_triangles.push_back({.p0 = packed_.positions[t.v0],
                                              .primitive = primitive,
                                              .p1 = packed_.positions[t.v1],
                                              .p2 = packed_.positions[t.v2]});
        }
        return first_node;
    }

private:
    HostScene& packed_;
};

/// An instance with its bounds. Its matrices in double: A, a of the map to the world, B, b of its rounded inverse.
class PlacedMesh {
public:
    /// `root`: of the mesh.
    PlacedMesh(const InstanceDescription& instance, const BvhNode& root)
        : root_(root), to_world_(instance.to_world), linear_(glm::mat3(instance.to_world)),
          offset_(instance.to_world[3]), inverse_(inverse_of(instance.to_world)),
          reach_(glm::max(glm::abs(Vec3d{root.low}), glm::abs(Vec3d{root.high}))),
          world_reach_(largest(row_sums(linear_, reach_) + glm::abs(offset_))) {}

    /// A kernel's corner is A c + a with at most four roundings of numbers up to world_reach_.
    Bounds bounds() const {
        Vec3d low{std::numeric_limits<double>::infinity()};
        Vec3d high{-low};
        for (const Vec3d& corner : box_corners({root_.low, root_.high}, to_world_)) {
            low = glm::min(low, corner);
            high = glm::max(high, corner);
        }
        const Vec3d slack{5.0 * kUnit * world_reach_};
        return rounded_outwards(low - slack, high + slack);
    }

    /// Instance::error and error_per_distance. With u the roundoff, O the largest component of a ray's origin o, G
    /// the largest component of the corners in the world, c a corner of the mesh, and the norms of rows: the ray test
    /// finds a hit o + t d within 18 u R of the triangle whose corners are A c + a, each within 4 u G (see
    /// box_slack()), and R <= O + G. The inverse takes it to within |B| (18 u R + 4 u G) + |B A - 1| |c| + |B a + b|
    /// of the mesh. The ray in the mesh is rounded: its origin by 4 u (|B| O + |b|), its direction times t by
    /// 3 u |B| R. The sum is at most u (|B| (26 O + 26 G) + 4 |b|) + |B A - 1| |c| + |B a + b|.
    void bound_errors(Instance& instance) const {
        glm::dmat3 inverse;
        Vec3d inverse_offset;
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column)
                inverse[column][row] = static_cast<double>(inverse_.rows[row][column]);
            inverse_offset[row] = static_cast<double>(inverse_.rows[row].w);
        }
        const double norm = largest(row_sums(inverse));
        const Vec3d inexact =
            row_sums(inverse * linear_ - glm::dmat3(1.0), reach_) + glm::abs(inverse * offset_ + inverse_offset);
        const double constant = kUnit * (32.0 * norm * world_reach_ + 8.0 * largest(inverse_offset));
        instance.error = static_cast<float>(1.01 * (constant + largest(inexact)));
        instance.error_per_distance = static_cast<float>(32.0 * kUnit * 1.01 * norm);
    }

private:
    const BvhNode& root_;
    const glm::mat4x3& to_world_;
    glm::dmat3 linear_;
    Vec3d offset_;
    Affine inverse_;
    Vec3d reach_;         ///< largest magnitudes of the mesh's coordinates
    double world_reach_;  ///< largest magnitude of a coordinate in the world
};

/// Largest factor by which a transformation lengthens vectors, or a little more: the root of a norm of A^T A.
double stretch_of(const glm::mat4x3& m) {
    const glm::dmat3 linear(glm::mat3{m});
    return std::sqrt(largest(row_sums(glm::transpose(linear) * linear)));
}

}  // namespace

double longest_instance_edge(const SceneDescription& scene, Span<const Triangle> triangles) {
    constexpr double kRounding = 1.0 + 1e-6;  // of the corners in the world
    std::vector<double> edges;
    for (const MeshDescription& mesh : scene.meshes)
        edges.push_back(longest_edge(view_of(scene.positions), triangles_of(mesh, triangles), usable_threads()));
    double longest = 0.0;
    for (const InstanceDescription& instance : scene.instances)
        longest = std::max(longest, kRounding * edges[instance.mesh] * stretch_of(instance.to_world));
    return longest;
}

void pack_instances(const SceneDescription& scene, HostScene& packed) {
    if (scene.instances.empty()) return;
    std::vector<std::uint32_t> roots;
    MeshPacker meshes(packed);
    for (const MeshDescription& mesh : scene.meshes) roots.push_back(meshes.add(mesh));
    std::uint32_t next = direct_triangles(scene);
    std::vector<Bounds> boxes;
    for (const InstanceDescription& description : scene.instances) {
        const MeshDescription& mesh = scene.meshes[description.mesh];
        const PlacedMesh placed(description, packed.mesh_nodes[roots[description.mesh]]);
        Instance instance{.to_world = affine_of(description.to_world),
                          .to_mesh = inverse_of(description.to_world),
                          .first_primitive = next,
                          .first_triangle = mesh.first_triangle,
                          .root = roots[description.mesh]};
        placed.bound_errors(instance);
        packed.instances.push_back(instance);
        packed.instance_primitives.push_back(next);
        boxes.push_back(placed.bounds());
        next += mesh.triangle_count;
    }
    Bvh bvh = build_bvh(view_of(std::as_const(boxes)));
    packed.instance_nodes = std::move(bvh.nodes);
    packed.instance_order = std::move(bvh.primitives);
}

}  // namespace pl
