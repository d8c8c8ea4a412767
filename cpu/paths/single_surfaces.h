// Surfaces that lanes do not know: points on them get their normals or their BSDF one by one.
#pragma once

#include <vector>

#include "core/kernel/integrator/roulette.h"
#include "core/kernel/methods/default.h"
#include "cpu/paths/vertex_block.h"

namespace pl {

/// The materials of these surfaces: those with images, blends or lobes; all of a scene with colors of vertices, or with instances.
template <FeatureSet F>
class SingleSurfaces {
public:
    static constexpr bool kAny = F.has_any(
        kLobeFeatures.with(features(Feature::Textures, Feature::NormalMaps, Feature::Blends, Feature::Instances)));

    explicit SingleSurfaces(const SceneView& scene) : scene_(scene), marks_(kAny ? scene.materials.count : 0) {
        for (std::uint32_t material = 0; material < marks_.size(); ++material)
            marks_[material] = static_cast<std::uint8_t>((needs_normal(material) ? kNormal : 0) |
                                                         (needs_bsdf(material) ? kBsdf : 0));
    }

    /// Completes the vertices of the paths in `hit` at such surfaces, and counts the specular ones. `rays`: of the block; `scattering`:
    /// paths at surfaces that reflect, as lanes know it, which is corrected. Returns the paths at specular surfaces.
    std::uint64_t reach(const PathSettings& settings, const BlockRows& block, const RayGroup* rays, auto& vertices,
                        std::uint64_t hit, std::uint64_t& scattering) const {
        std::uint64_t specular = 0;
        for_bits(hit, [&](std::uint32_t k) {
            const std::uint32_t lane = k % kGroupSize;
            const std::uint8_t marks = marks_[block.points[k / kGroupSize].material[lane]];
            if (marks == 0) return;
            const Vec3f b = hit_weights(block.hits[k / kGroupSize].get(lane));
            if ((marks & kNormal) != 0) bend_normal(k, b, block, vertices);
            if ((marks & kBsdf) == 0) return;
            const std::uint64_t bit = std::uint64_t{1} << k;
            const SurfacePoint surface = vertices.surface(k, block.points);
            const Bsdf<F> bsdf = make_bsdf<F>(scene_, surface, b, -rays[k / kGroupSize].get(lane).direction);
            vertices.set_albedo(k, bsdf.albedo());
            scattering = bsdf.scatters() ? scattering | bit : scattering & ~bit;
            if constexpr (F.has_any(kLobeFeatures)) {
                if (!bsdf.is_lambert()) vertices.set_layered(k, surface, bsdf);
                if (!bsdf.is_specular()) return;
                specular |= bit;
                count_specular_at(lane, settings, block.paths[k / kGroupSize]);
            }
        });
        return specular;
    }

private:
    static constexpr std::uint8_t kNormal = 1;  ///< the shading normal is not interpolated from the corners
    static constexpr std::uint8_t kBsdf = 2;    ///< the BSDF is not a Lambert reflector of one color

    bool needs_normal([[maybe_unused]] std::uint32_t material) const {
        if constexpr (F.has(Feature::NormalMaps)) {
            if (has_normal_map(scene_.textures, material)) return true;
        }
        return shows_instances<F>(scene_);
    }
    bool needs_bsdf([[maybe_unused]] std::uint32_t material) const {
        if constexpr (F.has(Feature::Textures)) {
            if (!scene_.vertex_colors.empty()) return true;
            const auto& images = scene_.textures.of_material;
            if (!images.empty() && images[material].albedo != kNoImage) return true;
        }
        if constexpr (F.has(Feature::Blends)) {
            if (!scene_.blends.empty() && scene_.blends[material].other != kNoBlend) return true;
        }
        if constexpr (F.has_any(kLobeFeatures))
            return !scene_.lobes.empty() && scene_.lobes[material].kind != SurfaceKind::Diffuse;
        return false;
    }

    void bend_normal(std::uint32_t k, Vec3f b, const BlockRows& block, auto& vertices) const {
        SurfacePoint flat = vertices.surface(k, block.points);
        flat.shading_normal = flat.geometric_normal;
        vertices.set_normal(k, with_shading_normal<F>(scene_, flat, b).shading_normal);
    }
    static void count_specular_at(std::uint32_t lane, const PathSettings& settings, PathGroup& paths) {
        PathState<F, DefaultMethod> state;
        state.vertices = paths.vertices[lane];
        state.specular_vertices = paths.specular[lane];
        count_specular(settings, state);
        paths.specular[lane] = state.specular_vertices;
    }

    const SceneView& scene_;
    std::vector<std::uint8_t> marks_;  ///< [material]
};

}  // namespace pl
