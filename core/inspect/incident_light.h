// The light that reaches a radiance volume, cell by cell, estimated by paths of `default` that start there: the truth beside the
// learned radiance. Independent of everything learned.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/fields/inspect_field.h"
#include "core/kernel/shading/bsdf.h"
#include "core/measure/statistics.h"
#include "core/session/backend.h"

namespace pl {

// The BSDF at the site of a radiance volume, in terms of the volume's cells.

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

    /// rms() of pi f(wo, wi) L, delta lobes left out: its mean over a cell is the mean of f L over cosine-weighted
    /// directions.
    float reflected(Vec3f wi, Vec3f radiance) const;
    /// Density of sampling wi, delta lobes left out, relative to the density of cosine sampling around the volume's
    /// normal.
    float pdf(Vec3f wi) const;
    /// Probability that no delta lobe is sampled.
    float guided_share() const { return 1.0f - bsdf_.delta_probability(); }

    /// pdf() at the points of VolumeInspection::density. [row][column]
    std::vector<float> fine_pdf() const;

private:
    LightReceiver receiver_;
    Bsdf<kEveryFeature> bsdf_;
};

/// Paths are dealt in turn to the groups of jackknife_interval().
inline constexpr int kLightGroups = kJackknifeGroups;

/// Light from a source that light sampling finds, too: its weight in a target depends on densities, so it is kept apart.
struct SampledEmission {
    std::uint32_t cell = 0;
    std::uint32_t group = 0;
    std::uint32_t fine_cell = 0;  ///< of VolumeInspection::density
    float light_pdf = 0.0f;       ///< density of light sampling, relative to cosine sampling
    float bsdf_pdf = 0.0f;        ///< density of BSDF sampling, relative to cosine sampling
    float radiance = 0.0f;        ///< rms() of its channels
    float reflected = 0.0f;       ///< rms() of the channels of pi f L: the part reflected towards wo
};

/// The paths so far. Arrays are [group][cell]; sums over paths of rms() of their channels.
struct IncidentLight {
    int side = 0;
    std::array<std::uint32_t, kLightGroups> paths{};  ///< per cell
    std::vector<double> radiance{};                   ///< without the sampled emission
    std::vector<double> reflected{};                  ///< pi f L, without it
    std::vector<SampledEmission> emission{};
    std::vector<float> bsdf_share{};  ///< probability that BSDF sampling takes the cell, delta lobes left out. [cell]
    float guided_share = 1.0f;        ///< of samples that are not of a delta lobe
    std::uint64_t invalid_paths = 0;  ///< NaN, infinite or negative: counted as black

    std::size_t cells() const { return static_cast<std::size_t>(side) * static_cast<std::size_t>(side); }
    /// Of all groups together, per cell.
    std::uint64_t paths_per_cell() const;
    /// Whether every group has a path, before which there are no figures.
    bool has_all_groups() const { return paths.back() > 0; }
};

/// Adds paths to an IncidentLight. Lights are sampled at every vertex but the volume itself, whose directions are spread evenly
/// over each cell. The same seed gives the same bits, in slices of any size.
class LightGatherer {
public:
    /// `path`: path_settings() of the baseline method; its stream and light sampling are set here.
    LightGatherer(std::shared_ptr<const HostScene> scene, const LightReceiver& receiver, PathSettings path);

    /// One more path through every cell. Returns false if `stop` was raised; the next call resumes there.
    bool advance(const StopFlag* stop = nullptr);

    const LightReceiver& receiver() const { return bsdf_.receiver(); }
    const IncidentLight& light() const { return light_; }

private:
    Vec2f point_in_cell(std::uint32_t cell, std::uint32_t round) const;
    void trace(std::uint32_t cell, std::uint32_t round);

    std::shared_ptr<const HostScene> scene_;
    SiteBsdf bsdf_;
    PathSettings path_;
    IncidentLight light_;
    std::uint32_t round_ = 0;
    std::uint32_t next_cell_ = 0;
};

}  // namespace pl
