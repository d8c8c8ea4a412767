// A model of GuidingField on the host: one mixture of von Mises-Fisher lobes per radiance volume, which guides by its product with
// the cosine at each point.   [Ruppert et al. 2020; Vorba et al. 2014, "On-line Learning of Parametric Mixture Models for Light
// Transport Simulation"]
#pragma once

#include "core/kernel/guiding/lobe_view.h"
#include "core/kernel/guiding/volume_irradiance.h"
#include "core/kernel/guiding/volume_lights.h"

namespace pl {

/// The volume that serves a surface point, and its mixture there, which sampling and density share.
struct LobeLocation {
    std::int32_t volume = kNoVolume;
    Vec3f offset{0.0f};  ///< see LobeView::offset_of()
    LobeMixture mixture;

    PL_HD bool is_served() const { return volume != kNoVolume; }
};

/// A sampled direction, and its weights in the sums.
struct LobeEntry {
    std::int32_t volume = kNoVolume;
    Vec3f offset{0.0f};
    Vec3f wi{0.0f};              ///< at the point, in the frame of the volume's normal
    float inverse_pdf = 0.0f;    ///< 1 / q in steradians, clamped
    float cosine_weight = 0.0f;  ///< cos / (pi q) with the volume's normal, clamped

    PL_HD bool is_trained() const { return volume != kNoVolume; }
};

/// Steps per unit of the sums of moments, and bounds of their factors: a sample adds less than 2^41 to any of them.
inline constexpr float kInverseSteps = 16384.0f;
inline constexpr float kSquareSteps = 65536.0f;
inline constexpr float kMostInverseDistance = 1024.0f;  ///< in units of 1 / extent
inline constexpr float kMostRelativeWeight = 1024.0f;   ///< of a sample to the mean, in kMomentSquare
inline constexpr float kMostMisfit = 65536.0f;
/// Responsibilities below this are left out of all sums.
inline constexpr float kLeastResponsibility = 0x1p-12f;

/// Steps per unit of a moment's sum. Units of moments of the weight are radiance units times steradians.
PL_HD inline float steps_of(std::uint32_t moment) {
    if (moment == kMomentInverse) return kInverseSteps;
    return moment >= kMomentSquare ? kSquareSteps : kStepsPerUnit;
}

struct LobeField : LobeView {
    using Location = LobeLocation;
    using Entry = LobeEntry;

    PL_HD Location locate(const SurfacePoint& surface) const {
        const std::int32_t volume = volume_at(surface);
        if (volume == kNoVolume) return {};
        const Vec3f offset = offset_of(volume, surface.position);
        const Vec3f normal = frame(volume).to_local(surface.shading_normal);
        return {volume, offset, product_at(static_cast<std::uint32_t>(volume), offset, normal)};
    }
    PL_HD Vec3f sample(const Location& location, const SurfacePoint&, const ScatterUniforms& uniforms) const {
        return frame(location.volume).to_world(location.mixture.sample({uniforms.u.y, uniforms.u.z}));
    }
    /// The bin is the direction itself, rounded.
    PL_HD FieldDensity density(const Location& location, const SurfacePoint&, Vec3f wi) const {
        const Vec3f local = frame(location.volume).to_local(wi);
        return {location.mixture.pdf_sa(local), pack_direction(local)};
    }
    PL_HD float bsdf_fraction_at(const Location& location) const { return bsdf_fraction[index_of(location)]; }
    PL_HD float value_at(const Location& location) const { return mean_radiance[index_of(location)]; }
    PL_HD float direct_at(const Location& location) const { return direct[index_of(location)]; }
    PL_HD float radiance_at(const Location& location, std::int32_t bin) const {
        const std::uint32_t volume = index_of(location);
        if (bin < 0 || !(total[volume] > 0.0f)) return value_at(location);
        return total[volume] * radiance_pdf_sa(volume, location.offset, unpack_direction(bin));
    }

    PL_HD Entry entry_of(const Location& location, const DirectionSample& direction) const {
        if (direction.bin < 0 || !(direction.pdf_sa > 0.0f)) return {};
        const Vec3f local = frame(location.volume).to_local(direction.wi);
        return {location.volume, location.offset, local, inverse_density(direction.pdf_sa),
                cosine_weight_of(local.z, direction.pdf_sa)};
    }
    PL_HD void record(const TrainingSample<LobeField>& sample, bool learns_fraction) const {
        count_irradiance(*this, static_cast<std::uint32_t>(sample.entry.volume), sample.entry.cosine_weight);
        add(sample, learns_fraction);
    }
    PL_HD void add(const TrainingSample<LobeField>& sample, bool learns_fraction) const {
        if (!(sample.target > 0.0f)) return;
        const Entry& entry = sample.entry;
        const auto volume = static_cast<std::uint32_t>(entry.volume);
        const float target = min_of(sample.target, kMaxRecordedUnits * radiance_unit);
        atomic_add(pending_value[volume], to_fixed_point(target * entry.cosine_weight, radiance_unit), writers);
        record_lobes(volume, entry, target, sample.distance);
        if (learns_fraction) record_fraction(*this, volume, volume, sample.bsdf_ratio, sample.target);
    }
    PL_HD LearnedLights lights_at(const Location& location) const { return lights_of_volume(*this, location.volume); }
    PL_HD void record_light(const LightSample<LobeField>& light) const { record_at_volume(*this, light); }
    PL_HD bool is_clamped(float target) const { return pl::is_clamped(target, radiance_unit); }

private:
    /// Light as the site sees it: its direction there, and one over its distance in units of 1 / extent.
    struct SiteLight {
        Vec3f wi;
        float inverse_distance;
    };

    static PL_HD std::uint32_t index_of(const Location& location) {
        return static_cast<std::uint32_t>(location.volume);
    }
    /// Without a distance, or from far away, the direction is the same at the site.
    PL_HD SiteLight light_at_site(const Entry& entry, float distance) const {
        // The nearest light, as a share of its distance, whose direction from the site still means something.
        constexpr float kNearest = 0.1f;
        const bool is_near = distance > 0.0f && distance < kInfinity && extent > 0.0f;
        const float inverse = is_near ? min_of(extent / distance, kMostInverseDistance) : 0.0f;
        const Vec3f towards = entry.wi + entry.offset * inverse;
        const float length = glm::length(towards);
        if (!(length > kNearest)) return {entry.wi, inverse};
        return {towards / length, min_of(inverse / length, kMostInverseDistance)};
    }
    /// The E step: adds the moments of a sample to each lobe, weighted by the lobe's responsibility.
    PL_HD void record_lobes(std::uint32_t volume, const Entry& entry, float target, float distance) const {
        const SiteLight light = light_at_site(entry, distance);
        float part[kMostLobes];
        const float pdf_sa = responsibilities(volume, light.wi, part);
        const float energy = min_of(target * entry.inverse_pdf / radiance_unit, kMaxRecordedUnits);
        const float relative = total[volume] > 0.0f ? energy * radiance_unit / total[volume] : 0.0f;
        const float misfit = relative * relative / (entry.inverse_pdf * max_of(pdf_sa, 1.0e-20f));
        const Vec3f d = light.wi;
        const float values[kLobeMoments] = {energy,
                                            energy * d.x,
                                            energy * d.y,
                                            energy * d.z,
                                            energy * light.inverse_distance,
                                            energy * d.x * d.x,
                                            energy * d.x * d.y,
                                            energy * d.x * d.z,
                                            energy * d.y * d.y,
                                            energy * d.y * d.z,
                                            square(min_of(relative, kMostRelativeWeight)),
                                            min_of(misfit, kMostMisfit)};
        for (std::uint32_t i = 0; i < lobe_count[volume]; ++i) {
            if (!(part[i] > kLeastResponsibility)) continue;
            std::int64_t* sums = pending_moments.data + kLobeMoments * (volume * kMostLobes + i);
            for (std::uint32_t m = 0; m < kLobeMoments; ++m)
                atomic_add(sums[m], static_cast<std::int64_t>(part[i] * values[m] * steps_of(m)), writers);
        }
    }
    /// Shares of the lobes in the mixture's density at the site, and that density. Where all lobes underflow, the nearest has it all.
    PL_HD float responsibilities(std::uint32_t volume, Vec3f wi, float (&part)[kMostLobes]) const {
        const std::uint32_t count = lobe_count[volume];
        float exponent[kMostLobes], density[kMostLobes] = {};
        for (std::uint32_t i = 0; i < count; ++i) {
            const VmfLobe lobe = lobe_of(volume, i);
            const Vec3f chord = wi - lobe.mean;
            exponent[i] = lobe.kappa * glm::dot(chord, chord);
            density[i] = weight_of(volume, i) * vmf_peak(lobe.kappa) * decay_of(0.5f * exponent[i]);
        }
        const float sum = sum_by_halves(density);
        if (sum > 1.0e-20f) {
            for (std::uint32_t i = 0; i < count; ++i) part[i] = density[i] / sum;
            return sum;
        }
        std::uint32_t nearest = 0;
        for (std::uint32_t i = 1; i < count; ++i)
            if (exponent[i] < exponent[nearest]) nearest = i;
        for (std::uint32_t i = 0; i < count; ++i) part[i] = i == nearest ? 1.0f : 0.0f;
        return sum;
    }
};
static_assert(RadianceField<LobeField>);

}  // namespace pl
