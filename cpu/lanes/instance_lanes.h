// Traversal of the instances of a scene by one ray after the other, whose tests of a node's children and of a leaf's triangles are in
// lanes. Included by one file per instruction set; see lanes.h.
#pragma once

#include "core/kernel/geometry/instance_traversal.h"
#include "cpu/lanes/leaf_lanes.h"
#include "cpu/lanes/node_walk.h"

namespace pl {
namespace {

/// Numbers of one point or vector for arithmetic over its axes; the last lane is unused.
struct Axes {
    using Real = FourLanes;
    using Mask = std::int32_t __attribute__((vector_size(16)));
    using Bits = std::uint32_t __attribute__((vector_size(16)));

    static PL_INLINE Real constant(float x) { return broadcast_to<Real>(x); }
    static PL_INLINE Real magnitude(const Real& x) {
        return std::bit_cast<Real>(std::bit_cast<Bits>(x) & 0x7fffffffu);
    }
    static PL_INLINE Real copy_sign(const Real& size, const Real& sign) {
        constexpr std::uint32_t kSign = 0x80000000u;
        return std::bit_cast<Real>((std::bit_cast<Bits>(size) & ~kSign) | (std::bit_cast<Bits>(sign) & kSign));
    }
    /// The largest of the axes.
    static PL_INLINE float longest(const Real& x) { return max_of(max_of(x[0], x[1]), x[2]); }
    static PL_INLINE Real of(Vec3f v) { return Real{v.x, v.y, v.z, v.z}; }
};

/// A ray in the space of a mesh, as make_mesh_box_ray() prepares it. Has the functions of GroupRay.
class MeshRay {
public:
    PL_INLINE MeshRay(const Instance& instance, const BvhNode& mesh, const RayGroup& rays, std::uint32_t lane) {
        const Vec3f from{rays.origin_x[lane], rays.origin_y[lane], rays.origin_z[lane]};
        const Axes::Real origin = Axes::of(instance.to_mesh.point(from));
        const Axes::Real direction = Axes::of(
            instance.to_mesh.vector({rays.direction_x[lane], rays.direction_y[lane], rays.direction_z[lane]}));
        const float reach = Axes::longest(
            larger(Axes::magnitude(Axes::of(mesh.low) - origin), Axes::magnitude(Axes::of(mesh.high) - origin)));
        const float distance = Axes::longest(Axes::magnitude(origin));
        const float slack = mesh_box_slack(instance, reach, distance, Axes::longest(Axes::magnitude(Axes::of(from))));
        const auto box =
            make_box_axis<Axes>(origin, direction, Axes::constant(Axes::longest(Axes::magnitude(direction))),
                                Axes::constant(reach + distance), Axes::constant(slack));
        const Axes::Mask is_backward = box.inverse_direction < 0.0f;
        inverse_direction_ = box.inverse_direction;
        at_[0] = is_backward ? box.at_high : box.at_low;
        at_[1] = is_backward ? box.at_low : box.at_high;
        near_side_ = is_backward & 1;
    }

    PL_INLINE float inverse_direction(int axis) const { return inverse_direction_[axis]; }
    PL_INLINE float at(int axis, int plane) const { return at_[plane][axis]; }
    PL_INLINE std::uint32_t near_side(int axis) const { return static_cast<std::uint32_t>(near_side_[axis]); }

private:
    Axes::Real inverse_direction_;
    Axes::Real at_[2];  ///< near and far plane
    Axes::Mask near_side_;
};

/// The triangles of an instance: corners as in Affine::point().
struct InScene {
    const Instance& instance;

    PL_INLINE void place(TestFloat (&rows)[4]) const {
        const TestFloat x = rows[0];
        const TestFloat y = rows[1];
        const TestFloat z = rows[2];
        for (int i = 0; i < 3; ++i) rows[i] = affine_coordinate(instance.to_world.rows[i], x, y, z);
    }
    PL_INLINE TestUint primitives(TestUint stored) const { return stored + instance.first_primitive; }
};

/// One ray's way through instances, from a hit that is known.
template <bool kAny>
class InstanceTraversal {
public:
    PL_INLINE InstanceTraversal(const WideInstances& scene, const RayGroup& rays, const PreparedGroup& prepared,
                                std::uint32_t lane)
        : scene_(scene), rays_(rays), ray_{&prepared, lane}, excluded_{rays.source[lane], rays.target[lane]},
          test_(prepared, lane) {}

    /// Returns true if `best` is another one then.
    PL_INLINE bool find(Hit& best) {
        const std::uint32_t before = best.primitive;
        walk_.start(0, stack_);
        while (!walk_.is_over()) {
            if (!walk_.is_at_leaf())
                walk_.descend(scene_.nodes, ray_, best.t);
            else if (find_in(scene_.order[walk_.at().first()], best))
                break;
            else
                walk_.leave(best.t);
        }
        return best.primitive != before;
    }

private:
    /// Returns true if there is a hit and any will do.
    PL_INLINE bool find_in(std::uint32_t number, Hit& best) {
        const Instance& instance = scene_.list[number];
        const MeshRay ray(instance, scene_.mesh_bounds[instance.root], rays_, ray_.lane);
        const InScene placing{instance};
        NodeWalk walk;
        walk.start(scene_.roots[number], mesh_stack_);
        while (!walk.is_over()) {
            if (!walk.is_at_leaf())
                walk.descend(scene_.mesh_nodes, ray, best.t);
            else if (test_.find(scene_.mesh_triangles, walk.at(), excluded_, best, placing))
                return true;
            else
                walk.leave(best.t);
        }
        return false;
    }

    const WideInstances& scene_;
    const RayGroup& rays_;
    GroupRay ray_;
    ExcludedPair excluded_;
    LeafTest<kAny> test_;
    NodeWalk walk_;
    EnteredChild stack_[kWideStack];
    EnteredChild mesh_stack_[kWideStack];
};

/// Calls visit(group number, lane, traversal) for the first `count` rays that can hit anything.
template <bool kAny, class Visit>
PL_INLINE void for_rays(const WideInstances& scene, const RayGroup* rays, std::uint32_t count, Visit&& visit) {
    PreparedGroup prepared;
    for (std::uint32_t group = 0; group < group_count(count); ++group) {
        prepare(scene.root, rays[group], prepared);
        const std::uint32_t end = min_of(kGroupSize, count - group * kGroupSize);
        for (std::uint32_t lane = 0; lane < end; ++lane) {
            if (((prepared.can_hit >> lane) & 1u) == 0) continue;
            InstanceTraversal<kAny> traversal(scene, rays[group], prepared, lane);
            visit(group, lane, traversal);
        }
    }
}

void find_closest_instances(const WideInstances& scene, const RayGroup* rays, HitGroup* hits, std::uint32_t count) {
    for_rays<false>(scene, rays, count, [&](std::uint32_t group, std::uint32_t lane, InstanceTraversal<false>& rest) {
        HitGroup& to = hits[group];
        Hit hit{to.t[lane], to.primitive[lane], to.b1[lane], to.b2[lane]};
        if (rest.find(hit)) store_hit(hit, to, lane);
    });
}

void find_occluding_instances(const WideInstances& scene, const RayGroup* rays, OcclusionMask* masks,
                              std::uint32_t count) {
    for_rays<true>(scene, rays, count, [&](std::uint32_t group, std::uint32_t lane, InstanceTraversal<true>& rest) {
        if (((masks[group] >> lane) & 1u) != 0) return;
        Hit hit{.t = rays[group].t_max[lane]};
        if (rest.find(hit)) masks[group] = static_cast<OcclusionMask>(masks[group] | (1u << lane));
    });
}

}  // namespace
}  // namespace pl
