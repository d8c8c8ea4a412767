// The common part of the walks of a placement: paths that sample the BSDF, independent of the picture's seed.
#pragma once

#include "core/kernel/base/rng.h"
#include "core/kernel/base/sobol.h"
#include "core/kernel/shading/bsdf.h"

namespace pl {

/// Placement depends on the scene and the camera, not on the picture's seed.
inline constexpr std::uint64_t kPlacementSeed = 0x706c6163656d656e;

/// Walks of one claim of a thread.
inline constexpr std::uint32_t kWalkChunk = 256;

/// Sample indices of the random numbers of the walks.
inline constexpr std::uint32_t kLightWalk = 0;
inline constexpr std::uint32_t kCameraWalk = 1;

/// Effects that walks know: neither colors nor the direction of facets matter to them.
inline constexpr FeatureSet kWalkEffects = kSurfaceFeatures.without(Feature::Anisotropy)
                                               .with(features(Feature::Blends, Feature::CutOuts))
                                               .with(kPlaceFeatures);

/// The direction in which a walk leaves a surface; black if it ends there. u in [0,1)^4.
inline Vec3f leave_surface(const SurfacePoint& point, const Bsdf<kWalkEffects>& bsdf, Vec4f u) {
    if (u.z < bsdf.delta_probability()) return bsdf.sample_delta(point, u.w).wi;
    return bsdf.sample(point, {u.x, u.y}, u.w);
}

/// Bits of `index` mirrored behind the binary point, in [0, 1).   [van der Corput 1935]
inline float radical_inverse(std::uint32_t index) { return to_unit_float(reversed_bits(index)); }

}  // namespace pl
