#include "core/fields/place_volumes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "core/fields/camera_walk.h"
#include "core/fields/walk.h"

namespace pl {
namespace {

/// One side of a surface, and its number of volumes.
struct Side {
    std::uint32_t surface;
    bool front;
    double area;
    std::uint32_t volumes = 0;
};

std::vector<Side> lit_sides_of(const LitSurfaces& found) {
    std::vector<Side> sides;
    for (std::uint32_t i = 0; i < found.surfaces.list.size(); ++i)
        for (const bool front : {true, false})
            if (found.lit[i][front ? 0 : 1]) sides.push_back({i, front, found.surfaces.list[i].area});
    return sides;
}

/// Gives each side its share by area, and at least one volume if there are enough for all.
void share_out(std::vector<Side>& sides, std::uint32_t volumes) {
    const bool one_each = sides.size() <= volumes;
    double area = 0.0;
    for (const Side& side : sides) area += side.area;
    // Sides too small for their share take one; that shrinks the share of the others, so the loop tests these again.
    for (bool changed = one_each; changed;) {
        changed = false;
        for (Side& side : sides) {
            if (side.volumes > 0 || side.area * volumes >= area) continue;
            side.volumes = 1;
            --volumes;
            area -= side.area;
            changed = true;
        }
    }
    // Systematic sampling of the cumulative area of the rest: each gets its share, rounded up or down.
    double running = 0.0;
    std::uint32_t given = 0;
    for (Side& side : sides) {
        if (side.volumes > 0) continue;
        running += side.area;
        const auto due = static_cast<std::uint32_t>(
            std::min(std::floor(running / area * volumes + 0.5), static_cast<double>(volumes)));
        side.volumes = one_each ? std::max(due - given, 1u) : due - given;
        given = due;
    }
}

/// A Hammersley set of `count` points over the cumulative area of one side.
void for_each_point(const SceneView& scene, const Surface& surface, const Side& side, std::uint32_t count,
                    const std::function<void(const SurfacePoint&)>& visit) {
    // Half a step of the mirrored numbers below `count`, so that the first point does not lie on an edge.
    const float half_step = 0.5f / static_cast<float>(std::bit_ceil(count));
    std::size_t current = 0;
    double start = 0.0;  // area of the triangles before the current one
    double area = area_of(scene, surface.triangles.front());
    for (std::uint32_t i = 0; i < count; ++i) {
        const double target = (i + 0.5) / count * side.area;
        while (target >= start + area && current + 1 < surface.triangles.size()) {
            start += area;
            area = area_of(scene, surface.triangles[++current]);
        }
        const auto across = static_cast<float>(std::clamp((target - start) / area, 0.0, 1.0));
        const Vec2f b = square_to_triangle({across, radical_inverse(i) + half_step});
        const Hit hit{.primitive = surface.triangles[current], .b1 = b.x, .b2 = b.y};
        const Vec3f normal = scene.planes[hit.primitive].normal;
        visit(make_surface_point<FeatureSet{}>(scene, hit, side.front ? normal : -normal));
    }
}

/// How many of the volumes are placed among the `points` of paths from the camera: half of them if there are more sides of surfaces than
/// volumes, and on instances, which have no surfaces here, as many as paths arrive there.
std::uint32_t volumes_by_paths(const SiteSource& source, bool has_many_sides, std::uint32_t volumes,
                               std::vector<SurfacePoint>& points) {
    if (source.camera == nullptr || (!has_many_sides && source.scene.instances.empty())) return 0;
    points = walk_from_camera(source.scene, *source.camera, source.threads);
    if (has_many_sides) return volumes / 2;
    const std::size_t all = std::max<std::size_t>(points.size(), 1);
    std::erase_if(points, [&](const SurfacePoint& point) { return point.primitive < source.scene.planes.size(); });
    return static_cast<std::uint32_t>(volumes * points.size() / all);
}

constexpr SurfaceLobes kDiffuse{};
constexpr MaterialImages kNoImages{};
constexpr MaterialOpacity kOpaque{};
constexpr MaterialBlend kPure{};

bool same_images(const MaterialImages& a, const MaterialImages& b) {
    return a.albedo == b.albedo && a.roughness == b.roughness && a.emission == b.emission;
}

bool same_opacity(const MaterialOpacity& a, const MaterialOpacity& b) {
    return a.image == b.image && a.factor == b.factor && a.blends == b.blends;
}

bool same_blend(const MaterialBlend& a, const MaterialBlend& b) {
    return a.other == b.other && a.share == b.share && a.image == b.image;
}

/// The properties of a material that the walks of a placement read.
struct Looks {
    const Material& material;
    const SurfaceLobes& lobes;
    const MaterialImages& images;
    const MaterialOpacity& opacity;
    const MaterialBlend& blend;

    Looks(const HostScene& scene, std::size_t index)
        : material(scene.materials[index]), lobes(scene.lobes.empty() ? kDiffuse : scene.lobes[index]),
          images(scene.material_images.empty() ? kNoImages : scene.material_images[index]),
          opacity(scene.opacities.empty() ? kOpaque : scene.opacities[index]),
          blend(scene.blends.empty() ? kPure : scene.blends[index]) {}

    /// Opaque and diffuse without images: the directions of a walk depend on neither color nor brightness, unless the
    /// albedo is 0.
    bool is_plain() const {
        return lobes.kind == SurfaceKind::Diffuse && same_images(images, kNoImages) && same_opacity(opacity, kOpaque);
    }
};

bool same_lobes(const SurfaceLobes& a, const SurfaceLobes& b) {
    return a.kind == b.kind && a.roughness == b.roughness && a.ior == b.ior && a.specular == b.specular &&
           a.transmission == b.transmission;
}

bool same_walks(const Looks& a, const Looks& b) {
    if (a.material.reflects() != b.material.reflects() ||
        a.material.two_sided_emission != b.material.two_sided_emission || !same_blend(a.blend, b.blend))
        return false;
    if (a.is_plain() && b.is_plain()) return true;
    return a.material.albedo == b.material.albedo && same_lobes(a.lobes, b.lobes) &&
           same_images(a.images, b.images) && same_opacity(a.opacity, b.opacity);
}

bool same_light(const Light& a, const Light& b) {
    return a.primitive == b.primitive && a.cumulative_probability == b.cumulative_probability;
}

}  // namespace

void for_each_site(const SiteSource& source, std::uint32_t density,
                   const std::function<void(const SurfacePoint&)>& visit) {
    const HostScene& scene = source.scene;
    std::vector<Side> sides = lit_sides_of(source.surfaces);
    const auto volumes = static_cast<std::uint32_t>(volume_count(source.settings, scene.light_clusters.size()));
    std::vector<SurfacePoint> points;
    const std::uint32_t by_paths = volumes_by_paths(source, sides.size() > volumes, volumes, points);
    share_out(sides, volumes - by_paths);
    for (const Side& side : sides)
        for_each_point(scene.view(), source.surfaces.surfaces.list[side.surface], side, density * side.volumes,
                       visit);
    if (by_paths == 0) return;
    std::ranges::for_each(choose_sites(std::move(points), density * by_paths), visit);
}

HostVolumes place_volumes(const SiteSource& source) {
    HostVolumes volumes;
    for_each_site(source, 1, [&](const SurfacePoint& site) {
        volumes.sites.push_back(site);
        volumes.normals.push_back(site.geometric_normal);
    });
    volumes.kd_nodes = build_kd_tree(view_of(std::as_const(volumes.sites)));
    return volumes;
}

HostVolumes place_volumes(const HostScene& scene, const FieldSettings& settings, const Camera* camera, int threads) {
    const LitSurfaces surfaces = find_lit_surfaces(scene, threads);
    return place_volumes({scene, surfaces, settings, camera, threads});
}

bool same_placement(const HostScene& before, const HostScene& after) {
    if (!std::ranges::equal(before.lights, after.lights, same_light)) return false;
    for (std::size_t i = 0; i < before.materials.size(); ++i)
        if (!same_walks(Looks(before, i), Looks(after, i))) return false;
    return true;
}

}  // namespace pl
