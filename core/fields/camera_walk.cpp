#include "core/fields/camera_walk.h"

#include <algorithm>
#include <span>

#include "core/base/parallel.h"
#include "core/fields/extent.h"
#include "core/fields/walk.h"
#include "core/kernel/base/rng.h"
#include "core/kernel/guiding/volume_lookup.h"
#include "core/kernel/integrator/holes.h"

namespace pl {
namespace {

constexpr std::uint32_t kCameraPaths = 8192;
constexpr std::uint32_t kMostArrivals = 5;  ///< of a path; later ones carry little light to the camera

void walk_path(const SceneView& scene, Ray ray, const Rng& rng, std::vector<SurfacePoint>& points) {
    const BvhIntersector intersector{scene};
    for (std::uint32_t vertex = 0; vertex < kMostArrivals; ++vertex) {
        const Hit hit = closest_solid_hit<kWalkEffects>(scene, intersector, ray);
        if (!hit.found()) return;
        const SurfacePoint point = make_surface_point<kPlaceFeatures>(scene, hit, -ray.direction);
        const Bsdf<kWalkEffects> bsdf = make_bsdf<kWalkEffects>(scene, point, hit_weights(hit), -ray.direction);
        if (!bsdf.scatters()) return;
        if (!bsdf.is_specular()) points.push_back(point);
        const Vec3f wi = leave_surface(point, bsdf, rng.draw(vertex, Purpose::Placement));
        if (is_black(wi)) return;
        ray = spawn_ray(point, wi);
    }
}

SurfacePoint nearest_to_mean(std::span<const SurfacePoint> points) {
    Vec3f sum{0.0f};
    for (const SurfacePoint& point : points) sum += point.position;
    const Vec3f mean = sum * (1.0f / static_cast<float>(points.size()));
    return *std::ranges::min_element(
        points, {}, [&](const SurfacePoint& point) { return squared_distance(point.position, mean); });
}

/// Chooses `count` sites among at least as many points.
void choose_among(std::span<SurfacePoint> points, std::size_t count, std::vector<SurfacePoint>& sites) {
    if (count == 0) return;
    if (count == 1) return sites.push_back(nearest_to_mean(points));
    const Vec3f normals = extent_of(points, &SurfacePoint::geometric_normal);
    // The squared chord of an angle is 2 (1 - cos): within it any of the points may be the site of all.
    const bool by_normal = glm::dot(normals, normals) > 2.0f * (1.0f - kMinNormalCosine);
    const auto vector = by_normal ? &SurfacePoint::geometric_normal : &SurfacePoint::position;
    const int axis = longest_axis(by_normal ? normals : extent_of(points, vector));
    std::ranges::stable_sort(points, {}, [=](const SurfacePoint& point) { return (point.*vector)[axis]; });
    const std::size_t half = count / 2;
    const std::size_t middle = points.size() * half / count;
    choose_among(points.first(middle), half, sites);
    choose_among(points.subspan(middle), count - half, sites);
}

}  // namespace

std::vector<SurfacePoint> walk_from_camera(const HostScene& scene, const Camera& camera, int threads) {
    using Points = std::vector<SurfacePoint>;
    const SceneView view = scene.view();
    const auto walk = [&](Points& points, IndexRange paths) {
        for (std::uint32_t i = paths.begin; i < paths.end; ++i) {
            const Vec2f film{(static_cast<float>(i) + 0.5f) / static_cast<float>(kCameraPaths), radical_inverse(i)};
            const Ray ray = generate_ray(camera, film, {1.0f, 1.0f});
            walk_path(view, ray, Rng{kPlacementSeed, Stream::Placement, i, kCameraWalk}, points);
        }
    };
    Points all;
    for (const Points& points : sums_of_chunks(kCameraPaths, kWalkChunk, threads, Points{}, walk))
        all.insert(all.end(), points.begin(), points.end());
    return all;
}

std::vector<SurfacePoint> choose_sites(std::vector<SurfacePoint> points, std::size_t count) {
    if (points.size() <= count) return points;
    std::vector<SurfacePoint> sites;
    sites.reserve(count);
    choose_among(points, count, sites);
    return sites;
}

}  // namespace pl
