// Failures of rays: passing between two triangles that share an edge, leaving a closed room, going through a wall
// whose shading normals lean, another hit of an instance than of a copy.
#pragma once

#include <sstream>

#include "tests/mutants/trace_many.h"
#include "tests/support/rays/brute_force.h"
#include "tests/support/rays/hard_rays.h"
#include "tests/support/rays/walk.h"
#include "tests/support/scenes/closed_scenes.h"
#include "tests/support/scenes/instanced_meshes.h"
#include "tests/support/statistics/rules.h"

namespace pl::test {

inline Decision never(std::uint64_t events, std::uint64_t tries) {
    std::ostringstream reason;
    reason << events << " of " << tries;
    return {events == 0 ? Verdict::Pass : Verdict::Fail, reason.str()};
}

/// Seed 41; 2e5 rays from inside at points of the edges of a closed mesh.
inline Decision check_edges() {
    constexpr std::uint64_t kRays = 200000;
    SceneDescription description;
    description.materials.push_back(gray());
    add_spiky_sphere(description, 12, 16, 0.7f, 1.3f, 9);
    const HostScene scene = pack_scene(description);
    const BvhIntersector intersector{scene.view()};
    Uniforms random(41);
    std::uint64_t missed = 0;
    for (std::uint64_t i = 0; i < kRays; ++i) {
        const Triangle& t = scene.triangles[random.below(static_cast<std::uint32_t>(scene.triangles.size()))];
        const Vec3f a = scene.positions[t.v0];
        const Vec3f b = scene.positions[t.v1];
        const Vec3f start = random.cube(-0.1f, 0.1f);
        const Ray ray{.origin = start, .direction = glm::normalize(a + random.next() * (b - a) - start)};
        missed += intersector.closest_hit(ray).found() ? 0 : 1;
    }
    return never(missed, kRays);
}

/// Seed 1; a walk of 1e5 segments in a turned room a thousand of its sizes from the origin, where rounding is largest, from
/// next to edges, too.
inline Decision check_walk() {
    constexpr std::uint64_t kSegments = 100000;
    SceneDescription room;
    room.materials.push_back(gray());
    add_box(room, {-1, -0.75f, -1.5f}, {1, 0.75f, 1.5f}, true);
    const Vec3f far{1e3f, -777.0f, 333.0f};
    transform(room, true, 1.0f, far);
    SceneDescription start;
    start.positions.push_back({0.1f, 0.6f, -0.9f});
    transform(start, true, 1.0f, far);
    const HostScene scene = pack_scene(room);
    const WalkResult result = walk(scene.view(), BvhIntersector{scene.view()}, start.positions.front(), kSegments,
                                   WalkStyle::Adversarial, 1);
    return never(result.escapes + result.leaks, kSegments);
}

/// Seed 23; 1e5 rays at hard points of instances far from the origin, and of copies.
inline Decision check_instances() {
    constexpr std::uint64_t kRays = 100000;
    SceneDescription description;
    description.materials.push_back(gray());
    add_spiky_sphere(description, 12, 12, 0.7f, 1.0f, 5);
    make_mesh(description, 0);
    Uniforms random(23);
    add_instances(description, random, 12, 3000.0f, 200.0f);
    const HostScene instanced = pack_scene(description);
    const HostScene copied = pack_scene(with_copies(description));
    const BvhIntersector by_instances{instanced.view()};
    const BvhIntersector by_copies{copied.view()};
    std::uint64_t differences = 0;
    for (std::uint64_t i = 0; i < kRays; ++i) {
        const Ray ray = hard_ray(copied.view(), random);
        differences += same_bits(by_copies.closest_hit(ray), by_instances.closest_hit(ray)) ? 0 : 1;
    }
    return never(differences, kRays);
}

/// Seed 1; 2e4 paths in a closed room whose shading normals lean by 80 degrees, under a bright sky.
inline Decision check_leaning() {
    constexpr FeatureSet kEffects = kWithNextEvent.with(Feature::SmoothNormals).with(Feature::Environment);
    SceneDescription room = furnace_scene(0.0f, 0.9f);
    room.environment = Vec3f{1.0f};
    for (TriangleDescription& triangle : room.triangles) {
        const Vec3f a = room.positions[triangle.vertex.x];
        const Vec3f along = glm::normalize(room.positions[triangle.vertex.y] - a);
        const Vec3f normal = glm::normalize(glm::cross(along, room.positions[triangle.vertex.z] - a));
        triangle.normal = glm::uvec3{static_cast<std::uint32_t>(room.normals.size())};
        room.normals.push_back(glm::normalize(normal + 5.67f * along));
    }
    constexpr std::uint32_t kPaths = 20000;
    std::uint64_t lit = 0;
    trace_many<kEffects>(pack_scene(room), room.camera, DefaultMethod{}, PathSettings{.next_event = 1}, {0, kPaths},
                         [&](const auto& state, const PathCounters& counters) {
                             lit += max_component(state.radiance) > 0.0f || counters.escaped > 0 ? 1 : 0;
                         });
    return never(lit, kPaths);
}

}  // namespace pl::test
