#include "core/inspect/first_hits.h"

#include <cmath>

#include "core/base/parallel.h"
#include "core/kernel/geometry/intersector.h"
#include "core/kernel/inspect/views.h"
#include "core/scene/pack_scene.h"

namespace pl {
namespace {

constexpr std::uint32_t kRowsAtOnce = 4;

void keep(FirstHits& hits, std::size_t pixel, Vec3f normal, Vec3f albedo, float nearness, float material) {
    for (int i = 0; i < 3; ++i) {
        hits.normal[i][pixel] = normal[i];
        hits.albedo[i][pixel] = albedo[i];
    }
    hits.nearness[pixel] = nearness;
    hits.material[pixel] = material;
}

/// Towards the neighbor where nearness changes less: across an edge the change belongs to no plane.
float slope(const std::vector<float>& nearness, std::size_t pixel, std::size_t step, bool has_before,
            bool has_after) {
    const float before = has_before ? nearness[pixel] - nearness[pixel - step] : kInfinity;
    const float after = has_after ? nearness[pixel + step] - nearness[pixel] : kInfinity;
    const float smaller = std::fabs(before) < std::fabs(after) ? before : after;
    return smaller < kInfinity ? smaller : 0.0f;
}

void find_slopes(FirstHits& hits) {
    const auto width = static_cast<std::size_t>(hits.width);
    for (std::vector<float>& plane : hits.slope) plane.resize(hits.count());
    for_indices(static_cast<std::uint32_t>(hits.count()), usable_threads(), [&](std::size_t i) {
        hits.slope[0][i] = slope(hits.nearness, i, 1, i % width > 0, i % width + 1 < width);
        hits.slope[1][i] = slope(hits.nearness, i, width, i >= width, i + width < hits.count());
    });
}

}  // namespace

FirstHits find_first_hits(const HostScene& scene, const CameraDescription& camera, int width, int height,
                          const std::atomic<bool>* stop) {
    FirstHits hits;
    hits.width = width;
    hits.height = height;
    for (auto* planes : {&hits.normal, &hits.albedo})
        for (std::vector<float>& plane : *planes) plane.resize(hits.count());
    hits.nearness.resize(hits.count());
    hits.material.resize(hits.count());
    const SceneView view = scene.view();
    const BvhIntersector intersector{view};
    const Camera lens = make_camera(camera, width, height);
    const Vec2f size{static_cast<float>(width), static_cast<float>(height)};
    const auto find = [&](std::size_t pixel, Vec2f film) {
        const Ray ray = generate_ray(lens, film, size);
        const Hit hit = closest_solid_hit<kEveryFeature>(view, intersector, ray);
        if (!hit.found()) return keep(hits, pixel, Vec3f{0.0f}, Vec3f{0.0f}, 0.0f, kNan);
        const Vec3f wo = -ray.direction;
        const FirstSurface surface{make_surface_point<kEveryFeature>(view, hit, wo), hit_weights(hit), wo, hit.t};
        const float depth = hit.t * glm::dot(ray.direction, lens.axis);
        keep(hits, pixel, surface.point.shading_normal, shown_albedo<kEveryFeature>(view, surface), 1.0f / depth,
             static_cast<float>(surface.point.material));
    };
    for_chunks(static_cast<std::uint32_t>(height), kRowsAtOnce, usable_threads(), [&](IndexRange rows) {
        if (stop != nullptr && *stop) return;
        for (std::uint32_t y = rows.begin; y < rows.end; ++y)
            for (int x = 0; x < width; ++x)
                find(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x),
                     {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
    });
    find_slopes(hits);
    return hits;
}

}  // namespace pl
