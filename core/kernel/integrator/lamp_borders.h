// Pixels that the borders of lamps cross, found from the lamps: the rays of a pixel meet a lamp smaller than the pixel too rarely
// to tell. The pixels found are refined by camera_emission.h.
#pragma once

#include "core/kernel/base/atomics.h"
#include "core/kernel/integrator/camera_emission.h"

namespace pl {

/// EmissionContext::looks() of the pass before whose refinement borders are marked: a picture in motion has one pass and pays nothing, but
/// in a warm-up.
inline constexpr std::uint32_t kMarkingLook = 2;
/// Largest distance on the film, in pixels, from the edge to the rays on both sides of it.
inline constexpr float kEdgeMargin = 0.25f;

/// An edge of an emissive triangle.
struct LampEdge {
    Vec3f from, to;
    Vec3f center;  ///< of the triangle
};

/// Whether the emission that the camera sees on one side of a point of an edge differs from the emission on the other
/// side.
template <FeatureSet F, class Rays>
PL_HD inline bool is_seen_border(const EmissionContext& context, const SceneView& scene, Rays& rays, Vec3f point,
                                 Vec3f to_center, float share) {
    EmissionSeen sides[2];
    rays.trace(
        2,
        [&](std::uint32_t i) {
            const Vec3f aim = point + (i == 0 ? share : -share) * to_center;
            return Ray{.origin = context.camera.eye, .direction = glm::normalize(aim - context.camera.eye)};
        },
        [&](std::uint32_t i, const Ray& ray, const Hit& hit) { sides[i] = seen_emission<F>(scene, ray, hit); });
    return sides[0].differs_from(sides[1]);
}

/// The part of a line on the film that lies on it, as shares of the line from 0 to 1.   [Liang and Barsky 1984]
struct FilmLine {
    Vec2f from, along;
    float begin = 0.0f;
    float end = 1.0f;

    PL_HD FilmLine(Vec2f first, Vec2f last, Vec2f resolution) : from(first), along(last - first) {
        for (int axis = 0; axis < 2; ++axis) {
            if (along[axis] == 0.0f) {
                if (!(from[axis] >= 0.0f && from[axis] < resolution[axis])) end = -1.0f;
                continue;
            }
            const float a = -from[axis] / along[axis];
            const float b = (resolution[axis] - from[axis]) / along[axis];
            begin = max_of(begin, min_of(a, b));
            end = min_of(end, max_of(a, b));
        }
    }
    PL_HD Vec2f at(float share) const { return from + share * along; }
    /// Where the line leaves the pixel that holds its points just after `share`.
    PL_HD float next_border(float share) const {
        constexpr float kOnward = 1e-3f;  // pixels
        float next = end;
        for (int axis = 0; axis < 2; ++axis) {
            if (along[axis] == 0.0f) continue;
            const float onward = along[axis] > 0.0f ? kOnward : -kOnward;
            const float border = along[axis] > 0.0f ? std::floor(at(share)[axis] + onward) + 1.0f
                                                    : std::ceil(at(share)[axis] + onward) - 1.0f;
            next = min_of(next, (border - from[axis]) / along[axis]);
        }
        return next;
    }
};

/// Marks the pixels of a film that a visible part of an edge crosses. Returns the number of rays traced.
template <FeatureSet F, class Rays>
PL_HD inline std::uint32_t mark_edge(const EmissionContext& context, const SceneView& scene, Rays& rays,
                                     const FilmView& film, const LampEdge& edge) {
    const Vec2f resolution{static_cast<float>(film.width), static_cast<float>(film.height)};
    const FilmPosition from = film_position(context.camera, edge.from, resolution);
    const FilmPosition to = film_position(context.camera, edge.to, resolution);
    const FilmPosition center = film_position(context.camera, edge.center, resolution);
    if (!(from.depth > 0.0f && to.depth > 0.0f && center.depth > 0.0f)) return 0;
    const FilmLine line(from.film, to.film, resolution);
    std::uint32_t traced = 0;
    float begin = line.begin;
    for (std::uint32_t i = 0; i < film.width + film.height && begin < line.end; ++i) {
        const float end = line.next_border(begin);
        const float middle = 0.5f * (begin + end);
        const Vec2f at = line.at(middle);
        const std::uint32_t x = min_of(static_cast<std::uint32_t>(max_of(at.x, 0.0f)), film.width - 1u);
        const std::uint32_t y = min_of(static_cast<std::uint32_t>(max_of(at.y, 0.0f)), film.height - 1u);
        // A share of the line on the film is not one of the edge: near parts appear longer.
        const float near_part = middle * from.depth;
        const Vec3f point = edge.from + near_part / (near_part + (1.0f - middle) * to.depth) * (edge.to - edge.from);
        const float margin = kEdgeMargin / max_of(glm::length(center.film - at), 1.0f);
        traced += 2;
        if (is_seen_border<F>(context, scene, rays, point, edge.center - point, margin))
            store_if_zero(film.pixels[y * film.width + x].emission.varies, EmissionSeen::kBorderMarked);
        begin = end > begin ? end : line.end;
    }
    return traced;
}

/// Marks the pixels that the borders of one lamp cross; any thread, any order: the same marks. `light` is an index of
/// SceneView::lights. Returns the number of rays traced. Through a lens no pixel is marked: lamps have no borders on its film.
template <FeatureSet F, class Rays>
PL_HD inline std::uint32_t mark_lamp_borders(const EmissionContext& context, const SceneView& scene, Rays& rays,
                                             const FilmView& film, std::uint32_t light) {
    if (context.camera.aperture_radius > 0.0f) return 0;
    const Triangle& triangle = scene.triangles[scene.lights[light].primitive];
    const Vec3f corners[] = {scene.positions[triangle.v0], scene.positions[triangle.v1],
                             scene.positions[triangle.v2]};
    const Vec3f center = (corners[0] + corners[1] + corners[2]) * (1.0f / 3.0f);
    std::uint32_t traced = 0;
    for (int i = 0; i < 3; ++i)
        traced += mark_edge<F>(context, scene, rays, film, {corners[i], corners[(i + 1) % 3], center});
    return traced;
}

}  // namespace pl
