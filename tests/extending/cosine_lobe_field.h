// The kernel model of a representation by one cosine lobe per radiance volume: the example of docs/extending.md. It learns the mean
// direction of incident radiance and samples a power of the cosine around it.
#pragma once

#include "core/kernel/guiding/volume_irradiance.h"
#include "core/kernel/guiding/volume_lights.h"

namespace pl::test {

template <template <class> class Learned, template <class> class Pending>
struct CosineLobeArrays : MixtureSums<Learned, Pending>,
                          VolumeIrradiance<Learned, Pending>,
                          LightSampleSums<Learned, Pending> {
    Learned<float> direction;                 ///< sum of target times direction; 0: nothing is known. [volume][3]
    Pending<std::int64_t> pending_direction;  ///< of new training samples, fixed point. [volume][3]
};

struct CosineLobeField : FieldView, CosineLobeArrays<ConstSpan, Span> {
    struct Location {
        std::int32_t volume = kNoVolume;

        PL_HD bool is_served() const { return volume != kNoVolume; }
        PL_HD std::uint32_t index() const { return static_cast<std::uint32_t>(volume); }
    };
    struct Entry {
        std::int32_t volume = kNoVolume;
        Vec3f wi{0.0f};
        float cosine_weight = 0.0f;  ///< see cosine_weight_of()

        PL_HD bool is_trained() const { return volume != kNoVolume; }
    };

    static constexpr float kExponent = 4.0f;

    PL_HD Location locate(const SurfacePoint& surface) const { return {volume_at(surface)}; }

    /// cos^n around the axis: z = u^(1/(n+1)). Directions below the surface are zero-valued samples.
    PL_HD Vec3f sample(const Location& location, const SurfacePoint&, const ScatterUniforms& numbers) const {
        const float z = std::pow(numbers.u.y, 1.0f / (kExponent + 1.0f));
        const float radius = std::sqrt(max_of(0.0f, 1.0f - z * z));
        const float angle = 2.0f * kPi * numbers.u.z;
        return make_frame(axis_of(location.index()))
            .to_world({radius * std::cos(angle), radius * std::sin(angle), z});
    }
    PL_HD FieldDensity density(const Location& location, const SurfacePoint&, Vec3f wi) const {
        const float pdf_sa = lobe_pdf_sa(location.index(), wi);
        return pdf_sa > 0.0f ? FieldDensity{pdf_sa, 0} : FieldDensity{};
    }
    /// The mean direction of incident radiance; the normal while it is unknown.
    PL_HD Vec3f axis_of(std::uint32_t volume) const {
        const Vec3f sum{direction[3 * volume], direction[3 * volume + 1], direction[3 * volume + 2]};
        return glm::dot(sum, sum) > 0.0f ? glm::normalize(sum) : normals[volume];
    }
    PL_HD float lobe_pdf_sa(std::uint32_t volume, Vec3f wi) const {
        const float cosine = glm::dot(axis_of(volume), wi);
        return cosine > 0.0f ? (kExponent + 1.0f) * (0.5f * kInvPi) * std::pow(cosine, kExponent) : 0.0f;
    }
    PL_HD float bsdf_fraction_at(const Location& location) const { return bsdf_fraction[location.index()]; }
    PL_HD float value_at(const Location& location) const { return mean_radiance[location.index()]; }
    PL_HD float direct_at(const Location& location) const { return direct[location.index()]; }

    PL_HD Entry entry_of(const Location& location, const DirectionSample& sampled) const {
        const float cosine = glm::dot(normals[location.index()], sampled.wi);
        return {location.volume, sampled.wi, cosine_weight_of(cosine, sampled.pdf_sa)};
    }
    PL_HD void record(const TrainingSample<CosineLobeField>& sample, bool learns_fraction) const {
        count_irradiance(*this, static_cast<std::uint32_t>(sample.entry.volume), sample.entry.cosine_weight);
        add(sample, learns_fraction);
    }
    PL_HD void add(const TrainingSample<CosineLobeField>& sample, bool learns_fraction) const {
        if (!(sample.target > 0.0f)) return;
        const auto volume = static_cast<std::uint32_t>(sample.entry.volume);
        const float target = min_of(sample.target, kMaxRecordedUnits * radiance_unit);
        atomic_add(pending_value[volume], to_fixed_point(target * sample.entry.cosine_weight, radiance_unit),
                   writers);
        for (std::uint32_t i = 0; i < 3; ++i) {
            const float part = target / radiance_unit * sample.entry.wi[static_cast<int>(i)];
            atomic_add(pending_direction[3 * volume + i], static_cast<std::int64_t>(part * kStepsPerUnit), writers);
        }
        if (learns_fraction) record_fraction(*this, volume, volume, sample.bsdf_ratio, sample.target);
    }
    PL_HD LearnedLights lights_at(const Location& location) const { return lights_of_volume(*this, location.volume); }
    PL_HD void record_light(const LightSample<CosineLobeField>& light) const { record_at_volume(*this, light); }
    PL_HD bool is_clamped(float target) const { return pl::is_clamped(target, radiance_unit); }
};
static_assert(GuidingField<CosineLobeField>);

}  // namespace pl::test
