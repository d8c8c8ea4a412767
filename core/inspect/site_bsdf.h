// The BSDF at the site of a radiance volume, in terms of the volume's cells.
#pragma once

#include <vector>

#include "core/fields/inspect_field.h"
#include "core/kernel/shading/bsdf.h"

namespace pl {

/// The volume, and the direction from which its surface is seen.
struct LightReceiver {
    std::int32_t volume = kNoVolume;
    SurfacePoint site{};
    Vec3f normal{0.0f, 0.0f, 1.0f};  ///< axis of the hemisphere
    Vec3f wo{0.0f, 0.0f, 1.0f};      ///< decides the BSDF of surfaces that are not Lambert reflectors
    int side = 0;                    ///< cells: side x side

    /// Seen from `eye`, or along the normal if that is behind the surface.
    static LightReceiver of(const VolumeInspection& volume, Vec3f eye);
};

class SiteBsdf {
public:
    SiteBsdf(const SceneView& scene, const LightReceiver& receiver);

    const LightReceiver& receiver() const { return receiver_; }

    /// rms() of pi f(wo, wi) L, delta lobes left out: its mean over a cell is that of f L over cosine-weighted directions.
    float reflected(Vec3f wi, Vec3f radiance) const;
    /// Density of sampling wi, delta lobes left out, relative to that of cosine sampling around the volume's normal.
    float pdf(Vec3f wi) const;
    /// Probability that no delta lobe is sampled.
    float guided_share() const { return 1.0f - bsdf_.delta_probability(); }

    /// pdf() at the points of VolumeInspection::density. [row][column]
    std::vector<float> fine_pdf() const;

private:
    LightReceiver receiver_;
    Bsdf<kEveryFeature> bsdf_;
};

}  // namespace pl
