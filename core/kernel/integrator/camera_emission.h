// Emission that the camera sees, apart from the light that surfaces reflect. A pixel that the border of a lamp or of a bright sky
// crosses has a variance that no sampling of directions reduces; there, further camera rays estimate the emission alone.
#pragma once

#include "core/kernel/film/film_view.h"
#include "core/kernel/film/pass_schedule.h"
#include "core/kernel/integrator/holes.h"
#include "core/kernel/integrator/steps.h"

namespace pl {

/// Sets of features that the kernels of camera emission are compiled for.
inline constexpr KernelRange kEmissionRange = KernelRange::Sparse;
/// Further camera rays of a sample in a pixel whose emission varies, at most; at the border of a sky, which is less bright than
/// lamps and may be long, fewer. With its own one they fill vectors of 16.
inline constexpr std::uint32_t kEmissionRays = 127;
inline constexpr std::uint32_t kSkyRays = 15;
/// Camera rays that decide whether the emission of a pixel varies.
inline constexpr std::uint32_t kBorderRays = 16;

/// Luminance of the environment above which its borders count: at the borders of a dimmer environment the samples of
/// a pixel have less noise from the border than further rays are worth.
inline constexpr float kBrightSky = 2.0f;

/// Whether the camera may see emission with borders.
PL_HD inline bool has_visible_emission(const SceneView& scene) {
    return !scene.lights.empty() || scene.far_probability > 0.0f || luminance(scene.environment) > kBrightSky;
}

/// The parameters common to all pixels of a pass.
struct EmissionContext {
    Camera camera;
    PathSettings settings;
    PixelGrid grid;
    std::uint32_t passes = 0;  ///< of the film, this one included
    PassSchedule schedule{};

    /// The number of the pass for looking at emission. The first pass of a warm-up is the second one, since later ones are measured, without
    /// the pixels that see lamps; and these do not look, so that nothing changes that they are measured against.
    PL_HD std::uint32_t looks() const {
        constexpr std::uint32_t kNoLook = 7;
        if (schedule.warm_up == 0) return passes;
        if (passes > schedule.warm_up) return passes - schedule.warm_up + 2;
        return passes == 1 ? 2 : kNoLook;
    }
};

/// Radiance emitted by the first surface along a ray, or by the environment.
template <FeatureSet F>
PL_HD inline Vec3f first_emission(const SceneView& scene, const Ray& ray, const Hit& hit) {
    if (!hit.found()) return environment_radiance<F>(scene, ray.direction);
    const SurfacePoint surface = make_surface_point<F>(scene, hit, -ray.direction);
    return emitted_at<F>(scene, surface, hit_weights(hit));
}

/// Finds the first solid surfaces along rays one by one. Drivers may offer the same for many at once.
template <FeatureSet F, Intersector I>
struct SingleRays {
    const SceneView& scene;
    const I& intersector;

    /// Calls use(i, ray, hit) with the rays ray_of(i) for i from 0 to count - 1; count is at most kEmissionRays + 1.
    template <class RayOf, class Use>
    PL_HD void trace(std::uint32_t count, const RayOf& ray_of, const Use& use) const {
        for (std::uint32_t i = 0; i < count; ++i) {
            const Ray ray = ray_of(i);
            use(i, ray, closest_solid_hit<F>(scene, intersector, ray));
        }
    }
    /// Calls add(i, emission) in the order of i, with first_emission() along the rays.
    template <class RayOf, class Add>
    PL_HD void trace_emission(std::uint32_t count, const RayOf& ray_of, const Add& add) const {
        trace(count, ray_of,
              [&](std::uint32_t i, const Ray& ray, const Hit& hit) { add(i, first_emission<F>(scene, ray, hit)); });
    }
};

/// The emission that a camera ray shows of its pixel. A bright sky is one value: its own pattern is no border.
template <FeatureSet F>
PL_HD inline EmissionSeen seen_emission(const SceneView& scene, const Ray& ray, const Hit& hit) {
    const float emitted = luminance(first_emission<F>(scene, ray, hit));
    if (hit.found()) return EmissionSeen::of(emitted);
    return emitted > kBrightSky ? EmissionSeen{EmissionSeen::kSky} : EmissionSeen::of(0.0f);
}

/// The correction mean(E) - E_0 by which the mean emission along `count` further camera rays of a pixel takes the place of the first
/// emission of the path of one sample. The rays of all samples of a half of the film continue one low-discrepancy sequence, which has
/// a random start of its own. Traces count + 1 rays.
template <FeatureSet F, class Rays>
PL_HD inline Vec3f emission_correction(const EmissionContext& context, Rays& rays, std::uint32_t pixel,
                                       std::uint32_t sample, std::uint32_t count) {
    const Vec4f start = path_rng(context.settings, pixel, sequence_of(sample)).draw(0, Purpose::Emission);
    const Vec4f own_start = pixel_start(context.settings, pixel, sample);
    Vec3f sum{0.0f};
    Vec3f own{0.0f};
    rays.trace_emission(
        count + 1,
        [&](std::uint32_t i) {
            const Vec4f u =
                i < count ? sequence_point(start, sample / 2 * count + i) : pixel_sample(own_start, sample);
            return camera_ray<F>(context.camera, context.grid, pixel, u);
        },
        [&](std::uint32_t i, Vec3f emission) { (i < count ? sum : own) += emission; });
    return sum * (1.0f / static_cast<float>(count)) - own;
}

/// Corners of a pixel; every straight border that crosses it parts them.
inline constexpr std::uint32_t kCorners = 4;

/// A camera ray of a pixel that tells of its emission: through a corner for the first kCorners numbers, else through
/// a point that is independent of the points of its samples.
template <FeatureSet F>
PL_HD inline Ray probing_ray(const EmissionContext& context, std::uint32_t pixel, std::uint32_t number) {
    Vec4f u = path_rng(context.settings, pixel, context.grid.sample).draw(number + 1, Purpose::Emission);
    if (number < kCorners) {
        u.x = static_cast<float>(number & 1u);
        u.y = static_cast<float>(number >> 1);
    }
    return camera_ray<F>(context.camera, context.grid, pixel, u);
}

/// Whether one of the eight neighbors of a pixel has seen another emission.
PL_HD inline bool differs_from_neighbors(const FilmView& film, std::uint32_t pixel) {
    const std::uint32_t x = pixel % film.width;
    const std::uint32_t y = pixel / film.width;
    for (std::uint32_t row = y > 0 ? y - 1 : 0; row <= min_of(y + 1, film.height - 1); ++row)
        for (std::uint32_t column = x > 0 ? x - 1 : 0; column <= min_of(x + 1, film.width - 1); ++column)
            if (film.pixels[pixel].emission.differs_from(film.pixels[row * film.width + column].emission))
                return true;
    return false;
}

/// Whether the emission along one ray, noting_ray(), is noted in this pass for every pixel whose emission is not known to vary.
/// `looks`: EmissionContext::looks().
PL_HD inline bool notes_emission(std::uint32_t looks) { return looks >= 2 && (looks & (looks - 1)) == 0; }
template <FeatureSet F>
PL_HD inline Ray noting_ray(const EmissionContext& context, std::uint32_t pixel) {
    return probing_ray<F>(context, pixel, kCorners);
}
template <FeatureSet F>
PL_HD inline void note_emission(const SceneView& scene, const Ray& ray, const Hit& hit, EmissionSeen& seen) {
    const EmissionSeen now = seen_emission<F>(scene, ray, hit);
    seen.varies = seen.border_with(now);
    seen.value = now.value;
}

/// Decides by further rays whether the emission of a pixel varies.
template <FeatureSet F, class Rays>
PL_HD inline void decide_border(const EmissionContext& context, const SceneView& scene, Rays& rays, FilmPixel& p,
                                std::uint32_t pixel) {
    p.emission.at_border = 1;
    rays.trace(
        kBorderRays, [&](std::uint32_t i) { return probing_ray<F>(context, pixel, i); },
        [&](std::uint32_t, const Ray& ray, const Hit& hit) {
            const EmissionSeen now = seen_emission<F>(scene, ray, hit);
            if (p.emission.varies == 0) p.emission.varies = p.emission.border_with(now);
        });
}

/// Looks for emission that varies within a pixel. In the looks 2, 4, 8, ... one ray notes a value; in the next ones, 3, 5, 9, ...,
/// further rays decide about pixels whose neighbors have seen another value. Returns the number of rays.
template <FeatureSet F, class Rays>
PL_HD inline std::uint32_t look_for_emission(const EmissionContext& context, const SceneView& scene, Rays& rays,
                                             const FilmView& film, std::uint32_t pixel) {
    if (notes_emission(context.looks())) {
        rays.trace(
            1, [&](std::uint32_t) { return noting_ray<F>(context, pixel); },
            [&](std::uint32_t, const Ray& ray, const Hit& hit) {
                note_emission<F>(scene, ray, hit, film.pixels[pixel].emission);
            });
        return 1;
    }
    if (!notes_emission(context.looks() - 1) || !differs_from_neighbors(film, pixel)) return 0;
    decide_border<F>(context, scene, rays, film.pixels[pixel], pixel);
    return kBorderRays;
}

/// Whether the samples of the passes before are refined already.
PL_HD inline bool is_refined(const EmissionSeen& seen) {
    return seen.varies == EmissionSeen::kLampBorder || seen.varies == EmissionSeen::kSkyBorder;
}

/// Samples of a pixel that a pass refines, the last ones up to the sample of the pass, and the further rays of each.
struct EmissionWork {
    std::uint32_t samples = 0;
    std::uint32_t rays = 0;

    PL_HD std::uint32_t all_rays() const { return samples * (rays + 1); }
};

/// The sample that a pass has added to a pixel whose emission varies; if the emission has just been found to vary,
/// also the samples of the passes before. `was_refined`:
/// is_refined() before this pass.
PL_HD inline EmissionWork emission_work(const EmissionContext& context, EmissionSeen& seen, bool was_refined) {
    if (seen.varies == 0) return {};
    if (seen.varies == EmissionSeen::kBorderMarked) seen.varies = EmissionSeen::kLampBorder;
    return {.samples = was_refined ? 1u : context.passes,
            .rays = seen.varies == EmissionSeen::kSkyBorder ? kSkyRays : kEmissionRays};
}

/// Does the work of a pixel: L = mean(E) + (path - E_0) in each sample. Calls correct(sample, weight, correction).
template <FeatureSet F, class Rays, class Correct>
PL_HD inline void refine_samples(const EmissionContext& context, Rays& rays, std::uint32_t pixel,
                                 const EmissionWork& work, const Correct& correct) {
    for (std::uint32_t i = 0; i < work.samples; ++i) {
        const std::uint32_t pass = context.passes - 1 - i;
        const std::uint32_t sample = i == 0 ? context.grid.sample : context.schedule.sample_of(pass);
        correct(sample, context.schedule.weight_of(pass),
                emission_correction<F>(context, rays, pixel, sample, work.rays));
    }
}
template <FeatureSet F, class Rays>
PL_HD inline void refine_samples(const EmissionContext& context, Rays& rays, const FilmView& film,
                                 std::uint32_t pixel, const EmissionWork& work) {
    refine_samples<F>(context, rays, pixel, work, [&](std::uint32_t sample, std::uint32_t weight, Vec3f correction) {
        correct_sample(film, pixel, correction, sample, weight);
    });
}

/// Looks for emission that varies within a pixel, and tells the samples to refine where it does. Unbiased, because the rays that look
/// for such pixels are independent of the samples. Adds the number of rays traced to `traced`.
template <FeatureSet F, class Rays>
PL_HD inline EmissionWork find_emission_work(const EmissionContext& context, const SceneView& scene, Rays& rays,
                                             const FilmView& film, std::uint32_t pixel, std::uint64_t& traced) {
    EmissionSeen& seen = film.pixels[pixel].emission;
    const bool was_refined = is_refined(seen);
    if (seen.varies == 0) traced += look_for_emission<F>(context, scene, rays, film, pixel);
    return emission_work(context, seen, was_refined);
}

/// Refines the samples of one pixel that find_emission_work() tells. Returns the number of rays traced.
template <FeatureSet F, class Rays>
PL_HD inline std::uint64_t refine_emission(const EmissionContext& context, const SceneView& scene, Rays& rays,
                                           const FilmView& film, std::uint32_t pixel) {
    std::uint64_t traced = 0;
    const EmissionWork work = find_emission_work<F>(context, scene, rays, film, pixel, traced);
    refine_samples<F>(context, rays, film, pixel, work);
    return traced + work.all_rays();
}

}  // namespace pl
