// Surfaces that lanes do not know: points on them get their normals or their BSDF one by one.
#pragma once

#include <vector>

#include "core/kernel/shading/bsdf.h"
#include "cpu/base/groups.h"

namespace pl {

/// The materials of these surfaces: those with images, blends or lobes; all of a scene with colors of vertices, or with instances.
template <FeatureSet F>
class SingleSurfaces {
public:
    static constexpr bool kAny = F.has_any(
        kLobeFeatures.with(features(Feature::Textures, Feature::NormalMaps, Feature::Blends, Feature::Instances)));

    explicit SingleSurfaces(const SceneView& scene) : marks_(kAny ? scene.materials.count : 0) {
        for (std::uint32_t material = 0; material < marks_.size(); ++material)
            marks_[material] = static_cast<std::uint8_t>((needs_normal(scene, material) ? kNormal : 0) |
                                                         (needs_bsdf(scene, material) ? kBsdf : 0));
    }

    /// Whether a normal is not that of the corners.
    bool has_normal(std::uint32_t material) const { return (marks_[material] & kNormal) != 0; }
    /// Whether a BSDF is not that of a Lambert reflector with the albedo of its material.
    bool has_bsdf(std::uint32_t material) const { return (marks_[material] & kBsdf) != 0; }

private:
    static constexpr std::uint8_t kNormal = 1;
    static constexpr std::uint8_t kBsdf = 2;

    static bool needs_normal(const SceneView& scene, [[maybe_unused]] std::uint32_t material) {
        if constexpr (F.has(Feature::NormalMaps)) {
            if (has_normal_map(scene.textures, material)) return true;
        }
        return shows_instances<F>(scene);
    }
    static bool needs_bsdf([[maybe_unused]] const SceneView& scene, [[maybe_unused]] std::uint32_t material) {
        if constexpr (F.has(Feature::Textures)) {
            if (!scene.vertex_colors.empty()) return true;
            const auto& images = scene.textures.of_material;
            if (!images.empty() && images[material].albedo != kNoImage) return true;
        }
        if constexpr (F.has(Feature::Blends)) {
            if (!scene.blends.empty() && scene.blends[material].other != kNoBlend) return true;
        }
        if constexpr (F.has_any(kLobeFeatures))
            return !scene.lobes.empty() && scene.lobes[material].kind != SurfaceKind::Diffuse;
        return false;
    }

    std::vector<std::uint8_t> marks_;  ///< [material]
};

}  // namespace pl
