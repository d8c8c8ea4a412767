// A light walk through the scene: paths from the lights find the sides of surfaces that light reaches.
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

#include "core/base/parallel.h"
#include "core/fields/surfaces.h"
#include "core/fields/walk.h"
#include "core/kernel/base/rng.h"
#include "core/kernel/integrator/holes.h"
#include "core/kernel/shading/lights.h"
#include "core/scene/bounds.h"

namespace pl {
namespace {

constexpr std::uint32_t kWalks = 4096;
constexpr std::uint32_t kMaxVertices = 16;
/// A side counts as lit if it receives more than one in this many arrivals at its surface; fewer are strays through
/// open edges.
constexpr std::uint32_t kStrayRatio = 50;

struct Arrivals {
    std::uint32_t front = 0;
    std::uint32_t back = 0;
};

/// Sphere around all triangles, for light from the environment.
struct BoundingSphere {
    Vec3f center{0.0f};
    float radius = 0.0f;
};

BoundingSphere bounding_sphere(const HostScene& scene) {
    Bounds bounds;
    for (const auto* nodes : {&scene.bvh_nodes, &scene.instance_nodes}) {
        if (nodes->empty()) continue;
        bounds.add(nodes->front().low);
        bounds.add(nodes->front().high);
    }
    if (bounds.empty()) return {};
    return {0.5f * bounds.low + 0.5f * bounds.high, 0.5f * bounds.diagonal()};
}

/// Starts at a light with a cosine-distributed direction; at two-sided lights, from either side with probability 1/2.
Ray leave_light(const HostScene& scene, const SceneView& view, Vec4f u, Vec4f v) {
    const std::uint32_t primitive = view.lights[choose_light(view, u.x)].primitive;
    SurfacePoint point = light_surface(view, primitive, sample_weights({u.y, u.z}), Vec3f{0.0f});
    const Material& material = scene.materials[point.material];
    const bool want_front = material.two_sided_emission == 0 || v.x < 0.5f;
    if (point.front != want_front) point.geometric_normal = -point.geometric_normal;
    point.shading_normal = point.geometric_normal;
    return spawn_ray(point, lambert_sample(point, {v.y, v.z}));
}

/// Uniform over the sphere.
Vec3f uniform_direction(Vec3f u) {
    const float cos_theta = 1.0f - 2.0f * u.x;
    const Vec2f circle = square_to_disk({u.y, u.z});
    // A uniform point of the disk, lifted to the sphere by its projection on a cylinder.   [Archimedes]
    const float radius2 = circle.x * circle.x + circle.y * circle.y;
    const float stretch = radius2 > 0.0f ? safe_sqrt((1.0f - cos_theta * cos_theta) / radius2) : 0.0f;
    return glm::normalize(Vec3f{circle.x * stretch, circle.y * stretch, cos_theta});
}

/// From outside, through a uniform point of the bounding sphere's disk perpendicular to a direction.
Ray enter_along(Vec3f direction, const BoundingSphere& sphere, Vec2f u) {
    const Vec2f disk = sphere.radius * square_to_disk(u);
    const Frame frame = make_frame(direction);
    const Vec3f origin = sphere.center + disk.x * frame.x + disk.y * frame.y - 2.0f * sphere.radius * direction;
    return {.origin = origin, .direction = direction};
}

/// Starts from the environment, in a uniform direction.
Ray enter_from_environment(const BoundingSphere& sphere, Vec4f u, Vec4f v) {
    return enter_along(uniform_direction(Vec3f{u}), sphere, {v.x, v.y});
}

/// Starts at one of the delta lights, all alike; at spots in any direction, of which those outside of the cone hit surfaces that bounces
/// may light.
Ray leave_delta_light(const HostScene& scene, const BoundingSphere& sphere, Vec4f u, Vec4f v) {
    const auto count = static_cast<std::uint32_t>(scene.delta_lights.size());
    const auto number = static_cast<std::uint32_t>(u.w * static_cast<float>(count));
    const DeltaLight& light = scene.delta_lights[std::min(number, count - 1)];
    if (light.kind == DeltaLightKind::Directional) return enter_along(light.axis, sphere, {v.x, v.y});
    return {.origin = light.position, .direction = uniform_direction(Vec3f{u})};
}

/// Where light walks start.
enum class Source { Environment, Lights, DeltaLights };

class LightWalker {
public:
    LightWalker(const HostScene& scene, const Surfaces& surfaces)
        : scene_(scene), view_(scene.view()), intersector_{view_}, surfaces_(surfaces),
          sphere_(bounding_sphere(scene)), arrivals_(surfaces.list.size()) {}

    std::vector<Arrivals> walk_all(int threads) {
        const bool sky = !is_black(scene_.environment) || !view_.far_lights.empty();
        std::vector<Source> sources;
        if (sky) sources.push_back(Source::Environment);
        if (!scene_.lights.empty()) sources.push_back(Source::Lights);
        if (!scene_.delta_lights.empty()) sources.push_back(Source::DeltaLights);
        if (sources.empty()) return arrivals_;
        for_chunks(kWalks, kWalkChunk, threads, [&](IndexRange walks) {
            for (std::uint32_t i = walks.begin; i < walks.end; ++i) {
                const Rng rng{kPlacementSeed, Stream::Placement, i, kLightWalk};
                const Vec4f u = rng.draw(0, Purpose::Placement);
                const Vec4f v = rng.draw(1, Purpose::Placement);
                walk(start(sources[i % sources.size()], u, v), rng);
            }
        });
        return arrivals_;
    }

private:
    Ray start(Source source, Vec4f u, Vec4f v) const {
        switch (source) {
        case Source::Environment: return enter_from_environment(sphere_, u, v);
        case Source::Lights: return leave_light(scene_, view_, u, v);
        case Source::DeltaLights: break;
        }
        return leave_delta_light(scene_, sphere_, u, v);
    }
    void walk(Ray ray, const Rng& rng) {
        for (std::uint32_t vertex = 0; vertex < kMaxVertices; ++vertex) {
            const Hit hit = closest_solid_hit<kWalkEffects>(view_, intersector_, ray);
            if (!hit.found()) return;
            const std::uint32_t surface = surfaces_.of_primitive(hit.primitive);
            const SurfacePoint point = make_surface_point<kPlaceFeatures>(view_, hit, -ray.direction);
            const Bsdf<kWalkEffects> bsdf = make_bsdf<kWalkEffects>(view_, point, hit_weights(hit), -ray.direction);
            if (!bsdf.scatters()) return;
            if (surface != kNoSurface) count(point.front ? arrivals_[surface].front : arrivals_[surface].back);
            ray = spawn_ray(point, leave_surface(point, bsdf, rng.draw(vertex + 2, Purpose::Placement)));
        }
    }

    static void count(std::uint32_t& arrivals) { std::atomic_ref(arrivals).fetch_add(1, std::memory_order_relaxed); }

    const HostScene& scene_;
    SceneView view_;
    BvhIntersector intersector_;
    const Surfaces& surfaces_;
    BoundingSphere sphere_;
    std::vector<Arrivals> arrivals_;
};

}  // namespace

std::vector<LitSides> find_lit_sides(const HostScene& scene, const Surfaces& surfaces, int threads) {
    std::vector<LitSides> sides;
    sides.reserve(surfaces.list.size());
    for (const Arrivals& a : LightWalker(scene, surfaces).walk_all(threads)) {
        const std::uint32_t total = a.front + a.back;
        sides.push_back({total == 0 || a.front * kStrayRatio > total, a.back * kStrayRatio > total});
    }
    return sides;
}

LitSurfaces find_lit_surfaces(const HostScene& scene, int threads) {
    LitSurfaces found{find_surfaces(scene, threads), {}};
    found.lit = find_lit_sides(scene, found.surfaces, threads);
    return found;
}

}  // namespace pl
