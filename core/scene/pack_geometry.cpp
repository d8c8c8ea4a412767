#include "core/scene/pack_steps.h"

#include <algorithm>
#include <utility>

#include "core/base/parallel.h"
#include "core/scene/build_bvh.h"
#include "core/scene/instances.h"
#include "core/scene/normals.h"
#include "core/scene/triangle_planes.h"

namespace pl {
namespace {

/// The triangles of the leaves in their order.
std::vector<BvhTriangle> leaf_triangles(const Bvh& bvh, const HostScene& packed) {
    std::vector<BvhTriangle> triangles(bvh.primitives.size());
    const auto pack = [&](std::uint32_t i) {
        const std::uint32_t primitive = bvh.primitives[i];
        const Triangle& t = packed.triangles[primitive];
        triangles[i] = {.p0 = packed.positions[t.v0],
                        .primitive = primitive,
                        .p1 = packed.positions[t.v1],
                        .p2 = packed.positions[t.v2]};
    };
    for_indices(static_cast<std::uint32_t>(triangles.size()), usable_threads(), pack);
    return triangles;
}

/// BvhView::leaves.
std::vector<SmallLeaf> leaves_of(const Bvh& bvh) {
    std::vector<SmallLeaf> leaves;
    if (bvh.primitives.size() > kMostSmallTriangles) return leaves;
    for (const BvhNode& node : bvh.nodes) {
        if (node.count == 0) continue;
        const std::uint64_t triangles = ((std::uint64_t{1} << node.count) - 1) << node.first;
        leaves.push_back({.low = node.low,
                          .first_triangles = static_cast<std::uint32_t>(triangles),
                          .high = node.high,
                          .last_triangles = static_cast<std::uint32_t>(triangles >> 32)});
    }
    return leaves;
}

/// The hierarchy over the triangles that are in the scene directly.
void pack_hierarchy(const SceneDescription& scene, HostScene& packed) {
    Bvh bvh = build_bvh(view_of(std::as_const(packed.positions)), {packed.triangles.data(), direct_triangles(scene)});
    packed.bvh_leaves = leaves_of(bvh);
    packed.bvh_triangles = leaf_triangles(bvh, packed);
    packed.bvh_nodes = std::move(bvh.nodes);
}

bool has_normals(const TriangleDescription& t) {
    return t.normal.x != TriangleDescription::kNoNormal && t.normal.y != TriangleDescription::kNoNormal &&
           t.normal.z != TriangleDescription::kNoNormal;
}

void pack_corners(const SceneDescription& scene, HostScene& packed) {
    packed.positions = scene.positions;
    packed.triangles.resize(scene.triangles.size());
    for_indices(static_cast<std::uint32_t>(scene.triangles.size()), usable_threads(), [&](std::uint32_t i) {
        const TriangleDescription& t = scene.triangles[i];
        packed.triangles[i] = {t.vertex.x, t.vertex.y, t.vertex.z, t.material};
    });
}

void pack_planes(const SceneDescription& scene, HostScene& packed) {
    const Span<const Triangle> all = view_of(std::as_const(packed.triangles));
    const Span<const Triangle> direct{all.data, direct_triangles(scene)};
    const double edge =
        std::max(longest_edge(view_of(scene.positions), direct, usable_threads()), longest_instance_edge(scene, all));
    packed.planes = make_triangle_planes(view_of(scene.positions), direct, edge, usable_threads());
    if (!scene.instances.empty()) packed.longest_edge = edge;
}

void pack_normals(const SceneDescription& scene, HostScene& packed) {
    bool any = false;
    for (const TriangleDescription& t : scene.triangles) any = any || has_normals(t);
    if (!any) return;
    packed.normals.reserve(scene.normals.size());
    for (const glm::vec3& n : scene.normals) packed.normals.push_back(unit_or_zero(Vec3d{n}));
    packed.triangle_normals.reserve(scene.triangles.size());
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const TriangleDescription& t = scene.triangles[i];
        if (has_normals(t)) {
            packed.triangle_normals.push_back({t.normal.x, t.normal.y, t.normal.z});
        } else {
            const auto flat = static_cast<std::uint32_t>(packed.normals.size());
            // None of a mesh: its geometric normal depends on the instance.
            packed.normals.push_back(i < packed.planes.size() ? packed.planes[i].normal : Vec3f{0.0f});
            packed.triangle_normals.push_back({flat, flat, flat});
        }
    }
}

}  // namespace

void pack_geometry(const SceneDescription& scene, HostScene& packed) {
    pack_corners(scene, packed);
    // Its construction takes the most memory: it comes before all that it does not need.
    pack_hierarchy(scene, packed);
    pack_planes(scene, packed);
    pack_normals(scene, packed);
}

}  // namespace pl
