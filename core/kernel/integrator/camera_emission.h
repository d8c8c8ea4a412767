// Emission that the camera sees, apart from the light that surfaces reflect. A pixel that the border of a lamp crosses has a
// variance that no sampling of directions reduces; there, further camera rays estimate the emission alone.
#pragma once

#include "core/kernel/film/film_view.h"
#include "core/kernel/integrator/holes.h"
#include "core/kernel/integrator/steps.h"

namespace pl {

/// Sets of features that the kernels of camera emission are compiled for.
inline constexpr KernelRange kEmissionRange = KernelRange::Sparse;
/// Further camera rays of a sample in a pixel whose emission varies.
inline constexpr std::uint32_t kEmissionRays = 16;

/// The parameters common to all pixels of a pass.
struct EmissionContext {
    Camera camera;
    PathSettings settings;
    PixelGrid grid;
};

/// Radiance emitted by the first surface along a ray; 0 on a miss: the environment is no surface.
template <FeatureSet F, Intersector I>
PL_HD inline Vec3f first_emission(const SceneView& scene, const I& intersector, const Ray& ray) {
    const Hit hit = closest_solid_hit<F>(scene, intersector, ray);
    if (!hit.found()) return Vec3f{0.0f};
    const SurfacePoint surface = make_surface_point<F>(scene, hit, -ray.direction);
    return emitted_at<F>(scene, surface, hit_weights(hit));
}

/// Mean emission of kEmissionRays camera rays of a pixel for one sample. The rays of all samples of a half of the film continue one
/// low-discrepancy sequence, which has a random start of its own.
template <FeatureSet F, Intersector I>
PL_HD inline Vec3f mean_emission(const EmissionContext& context, const SceneView& scene, const I& intersector,
                                 std::uint32_t pixel, std::uint32_t sample) {
    const Vec4f start = path_rng(context.settings, pixel, sequence_of(sample)).draw(0, Purpose::Emission);
    Vec3f sum{0.0f};
    for (std::uint32_t i = 0; i < kEmissionRays; ++i) {
        const Vec4f u = sequence_point(start, sample / 2 * kEmissionRays + i);
        sum += first_emission<F>(scene, intersector, camera_ray<F>(context.camera, context.grid, pixel, u));
    }
    return sum * (1.0f / kEmissionRays);
}

/// Replaces the first emission E_0 of the path of one sample in the film: L = mean(E) + (path - E_0).
template <FeatureSet F, Intersector I>
PL_HD inline void replace_emission(const EmissionContext& context, const SceneView& scene, const I& intersector,
                                   const FilmView& film, std::uint32_t pixel, std::uint32_t sample) {
    const Vec4f start = pixel_start(context.settings, pixel, sample);
    const Ray own = camera_ray<F>(context.camera, context.grid, pixel, pixel_sample(start, sample));
    const Vec3f mean = mean_emission<F>(context, scene, intersector, pixel, sample);
    correct_sample(film, pixel, mean - first_emission<F>(scene, intersector, own), sample);
}

/// Emission towards the camera along one ray of a pixel that is independent of those of its samples. `number` from 1 on.
template <FeatureSet F, Intersector I>
PL_HD inline EmissionSeen probe_emission(const EmissionContext& context, const SceneView& scene, const I& intersector,
                                         std::uint32_t pixel, std::uint32_t number) {
    const Vec4f u = path_rng(context.settings, pixel, context.grid.sample).draw(number, Purpose::Emission);
    const Ray ray = camera_ray<F>(context.camera, context.grid, pixel, u);
    return EmissionSeen::of(luminance(first_emission<F>(scene, intersector, ray)));
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

/// Looks for emission that varies within a pixel. In the passes 2, 4, 8, ... one ray notes a value; in the next ones, 3, 5, 9, ...,
/// further rays decide about pixels whose neighbors have seen another value. Returns the number of rays.
template <FeatureSet F, Intersector I>
PL_HD inline std::uint32_t look_for_emission(const EmissionContext& context, const SceneView& scene,
                                             const I& intersector, const FilmView& film, std::uint32_t pixel) {
    FilmPixel& p = film.pixels[pixel];
    const std::uint32_t count = p.samples + p.invalid;
    const auto is_power_of_two = [](std::uint32_t n) { return n >= 2 && (n & (n - 1)) == 0; };
    if (is_power_of_two(count)) {
        const EmissionSeen now = probe_emission<F>(context, scene, intersector, pixel, 1);
        p.emission.varies = p.emission.differs_from(now) ? 1 : 0;
        p.emission.value = now.value;
        return 1;
    }
    if (!is_power_of_two(count - 1) || !differs_from_neighbors(film, pixel)) return 0;
    p.emission.at_border = 1;
    for (std::uint32_t i = 1; i <= kEmissionRays; ++i) {
        const EmissionSeen now = probe_emission<F>(context, scene, intersector, pixel, i);
        if (p.emission.differs_from(now)) p.emission.varies = 1;
    }
    return kEmissionRays;
}

/// Refines the sample that a pass has added to a pixel, if the emission that the camera sees there varies; once it is found to vary,
/// those of the passes before, too, which have the numbers before that of this one. Unbiased, because the rays that look for
/// such pixels have random numbers of their own. Returns the number of rays traced.
template <FeatureSet F, Intersector I>
PL_HD inline std::uint32_t refine_emission(const EmissionContext& context, const SceneView& scene,
                                           const I& intersector, const FilmView& film, std::uint32_t pixel) {
    const FilmPixel& p = film.pixels[pixel];
    const std::uint32_t last = context.grid.sample;
    std::uint32_t refined = p.emission.varies;
    std::uint32_t rays = 0;
    if (refined == 0) {
        rays = look_for_emission<F>(context, scene, intersector, film, pixel);
        if (p.emission.varies != 0) refined = min_of(p.samples + p.invalid, last + 1);
    }
    for (std::uint32_t i = 0; i < refined; ++i)
        replace_emission<F>(context, scene, intersector, film, pixel, last - i);
    return rays + refined * (kEmissionRays + 1);
}

}  // namespace pl
