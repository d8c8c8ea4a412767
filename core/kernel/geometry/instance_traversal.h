// Traversal of the instances of a scene: a hierarchy over instances, in the space of the scene, and below each
// instance the hierarchy of its mesh, in the space of the mesh. Triangles are tested in the space of the scene, with
// the corners that copies of them would have: hits have the same bits as in a scene with copies.
#pragma once

#include "core/kernel/scene/instances.h"

namespace pl {

/// A ray in the space of a mesh: the same distances, another direction.
PL_HD inline Ray ray_in_mesh(const Instance& instance, const Ray& ray) {
    return {.origin = instance.to_mesh.point(ray.origin), .direction = instance.to_mesh.vector(ray.direction)};
}

/// box_slack() of a ray in the space of a mesh, and the error of the transformation, see Instance::error. `from`: the largest component
/// of the ray's origin in the scene.
PL_INLINE float mesh_box_slack(const Instance& instance, float reach, float origin, float from) {
    return box_slack(reach, origin) + instance.error + instance.error_per_distance * from;
}

/// The ray for the boxes of a mesh.
PL_HD inline BoxRay make_mesh_box_ray(const Instance& instance, const BvhNode& root, const Ray& ray,
                                      const Ray& in_mesh) {
    const float reach =
        max_component(glm::max(absolute(root.low - in_mesh.origin), absolute(root.high - in_mesh.origin)));
    const float origin = max_component(absolute(in_mesh.origin));
    return make_box_ray(in_mesh, reach + origin,
                        mesh_box_slack(instance, reach, origin, max_component(absolute(ray.origin))));
}

/// Tests the triangles of one instance that the ray may meet: `test(p0, p1, p2, primitive, best)` updates the closest hit and returns
/// true to stop. Returns whether it did.
template <class Test>
PL_HD inline bool traverse_instance(const InstancesView& instances, const Instance& instance, const Ray& ray,
                                    Hit& best, Test&& test) {
    const BvhNode root = instances.mesh_nodes[instance.root];
    const Ray in_mesh = ray_in_mesh(instance, ray);
    const BoxRay box_ray = make_mesh_box_ray(instance, root, ray, in_mesh);
    const auto test_leaf = [&](NodeReference leaf, Hit& hit) {
        for (std::uint32_t i = 0; i < leaf.count(); ++i) {
            const BvhTriangle triangle = instances.mesh_triangles[leaf.first() + i];
            const std::uint32_t primitive = instance.first_primitive + triangle.primitive;
            if (test(instance.to_world.point(triangle.p0), instance.to_world.point(triangle.p1),
                     instance.to_world.point(triangle.p2), primitive, hit))
                return true;
        }
        return false;
    };
    return traverse_nodes(instances.mesh_nodes.data, root, box_ray, best, test_leaf);
}

/// Tests the triangles of all instances that the ray may meet before `best`. Returns whether `test` stopped.
template <class Test>
PL_HD inline bool traverse_instances(const InstancesView& instances, const Ray& ray, Hit& best, Test&& test) {
    if (instances.empty() || !can_hit(ray)) return false;
    const BvhNode root = instances.nodes[0];
    const auto visit = [&](NodeReference leaf, Hit& hit) {
        for (std::uint32_t i = 0; i < leaf.count(); ++i)
            if (traverse_instance(instances, instances.list[instances.order[leaf.first() + i]], ray, hit, test))
                return true;
        return false;
    };
    return traverse_nodes(instances.nodes.data, root, make_box_ray(root, ray), best, visit);
}

}  // namespace pl
