// Views of the first surface of each pixel: geometry, materials, direct light, and numbers of the radiance volumes.
#pragma once

#include "core/kernel/guiding/placement_view.h"
#include "core/kernel/integrator/holes.h"
#include "core/kernel/integrator/steps.h"
#include "core/kernel/methods/default.h"

namespace pl {

enum class View : std::uint32_t {
    Beauty,
    Direct,
    RadianceMap,
    Voronoi,
    Normal,
    Albedo,
    Depth,
    // Heat maps: a number of the volume that serves a point, see volume_value().
    Visits,
    Irradiance,
    Entropy,
    BsdfShare,
    Change,
    Unvisited,
};
inline constexpr int kViewCount = 13;
/// Sets of features that the kernels of all views but Beauty are compiled for.
inline constexpr KernelRange kViewRange = KernelRange::Sparse;

/// Whether a view shows a number per volume. Its films hold the numbers of the last pass, not a mean over passes.
PL_HD constexpr bool is_heat_map(View view) { return view >= View::Visits; }

/// Pseudorandom color of a number, in [0.15, 1] per channel.
PL_HD inline Vec3f color_of_id(std::uint32_t id) {
    const Philox block = philox4x32({{id, 0, 0, 0}}, 0x9E3779B9u, 0xBB67AE85u);
    return Vec3f{0.15f} +
           0.85f * Vec3f{to_unit_float(block.v[0]), to_unit_float(block.v[1]), to_unit_float(block.v[2])};
}

/// The part of a field that views show, for any representation that keeps numbers per volume.
struct ShownField {
    PlacementView placement;
    /// Heat maps: volume_value(); View::RadianceMap: learned irradiance / pi; other views: empty. [volume]
    Span<const float> volume_values;
};

/// The color of a volume in the views of cells and heat maps; black without a volume.
PL_HD inline Vec3f shown_volume(View view, const ShownField& shown, std::int32_t volume) {
    if (volume == kNoVolume) return Vec3f{0.0f};
    const auto number = static_cast<std::uint32_t>(volume);
    return is_heat_map(view) ? Vec3f{shown.volume_values[number]} : color_of_id(number);
}

/// The first surface seen through a pixel.
struct FirstSurface {
    SurfacePoint point;
    Vec3f weights{0.0f};  ///< barycentric
    Vec3f wo{0.0f};       ///< towards the camera
    float distance = 0.0f;
};

/// Albedo of the diffuse, or guided, lobe.
template <FeatureSet F>
PL_HD inline Vec3f shown_albedo(const SceneView& scene, const FirstSurface& surface) {
    return albedo_at<F>(scene, shown_material<F>(scene, surface.point, surface.weights, surface.wo));
}

/// Whitted-style ray tracing without recursion: emission plus one light sample.
template <FeatureSet F, Intersector I>
PL_HD inline Vec3f direct_radiance(const SceneView& scene, const I& intersector, const FirstSurface& surface,
                                   const Rng& rng) {
    const Vec3f emitted = emitted_at<F>(scene, surface.point, surface.weights);
    const Vec4f u = rng.draw(0, Purpose::Light);
    const Bsdf<F> bsdf = make_bsdf<F>(scene, surface.point, surface.weights, surface.wo);
    const DirectLight sample = sample_direct_light<F>(scene, surface.point, bsdf, u);
    if (!(sample.pdf_sa > 0.0f) || is_blocked<F>(scene, intersector, shadow_ray_to<F>(surface.point, sample)))
        return emitted;
    return emitted + bsdf.eval(surface.point, sample.wi, sample.cos_i) * sample.emitted * (1.0f / sample.pdf_sa);
}

/// Radiance of a camera ray that misses all surfaces.
template <FeatureSet F>
PL_HD inline Vec3f background(const SceneView& scene, Vec3f direction) {
    Vec3f radiance{0.0f};
    if constexpr (F.has(Feature::Environment)) radiance = scene.environment;
    if constexpr (F.has(Feature::EnvironmentMap)) {
        if (!scene.far_lights.empty()) radiance += far_radiance(scene.far_lights, direction);
    }
    return radiance;
}

/// Learned irradiance / pi around a point: the mean over the nearest volumes, with weights that fall to zero at the
/// distance of the last one, so that the result is continuous. Biased: a preview, not a picture.
PL_HD inline float interpolated_mean_radiance(const ShownField& shown, const SurfacePoint& surface) {
    NearestSeveral<8> nearest;
    search_kd_tree(shown.placement.tree, surface.position, surface.geometric_normal, nearest);
    if (nearest.found == 0) return 0.0f;
    const float reach = std::sqrt(nearest.distance2[nearest.found - 1]) * 1.0001f;
    float sum = 0.0f;
    float weight_sum = 0.0f;
    for (int i = 0; i < nearest.found; ++i) {
        const float ratio = reach > 0.0f ? std::sqrt(nearest.distance2[i]) / reach : 0.0f;
        const float weight = square(1.0f - ratio) + 1.0e-6f;  // keeps the sum positive if there is only one volume
        sum += weight * shown.volume_values[static_cast<std::uint32_t>(nearest.volume[i])];
        weight_sum += weight;
    }
    return sum / weight_sum;
}

/// The parameters common to all samples of a view in one pass.
struct ViewContext {
    View view = View::Normal;
    ShownField shown;
    Camera camera;
    PathSettings settings;
    PixelGrid grid;
};

/// Value of a view at the first surface. Depth is in scene units; heat maps repeat their number in all three channels.
template <FeatureSet F, Intersector I>
PL_HD inline Vec3f surface_view(const ViewContext& context, const SceneView& scene, const I& intersector,
                                const FirstSurface& surface, const Rng& rng) {
    switch (context.view) {
    case View::Beauty: return Vec3f{0.0f};
    case View::Direct: return direct_radiance<F>(scene, intersector, surface, rng);
    case View::RadianceMap:
        return emitted_at<F>(scene, surface.point, surface.weights) +
               shown_albedo<F>(scene, surface) * interpolated_mean_radiance(context.shown, surface.point);
    case View::Normal: return 0.5f * (surface.point.shading_normal + Vec3f{1.0f});
    case View::Albedo: return shown_albedo<F>(scene, surface);
    case View::Depth: return Vec3f{surface.distance};
    case View::Voronoi:
    case View::Visits:
    case View::Irradiance:
    case View::Entropy:
    case View::BsdfShare:
    case View::Change:
    case View::Unvisited:
        return shown_volume(context.view, context.shown, context.shown.placement.volume_at(surface.point));
    }
    return Vec3f{0.0f};
}

/// One sample of a view for one pixel.
template <FeatureSet F, Intersector I>
PL_HD inline Vec3f sample_view(const ViewContext& context, const SceneView& scene, const I& intersector,
                               std::uint32_t pixel) {
    const auto state = begin_path<F, DefaultMethod>(context.camera, context.settings, context.grid, pixel);
    const Hit hit = closest_solid_hit<F>(scene, intersector, state.ray);
    if (!hit.found()) return context.view == View::Direct ? background<F>(scene, state.ray.direction) : Vec3f{0.0f};
    const Vec3f wo = -state.ray.direction;
    const FirstSurface surface{make_surface_point<F>(scene, hit, wo), hit_weights(hit), wo, hit.t};
    return surface_view<F>(context, scene, intersector, surface,
                           path_rng(context.settings, pixel, context.grid.sample));
}

}  // namespace pl
