// A representation of a guiding field by one cosine lobe per radiance volume: the example of docs/extending.md. It learns the mean
// direction of incident radiance and samples a power of the cosine around it.
#pragma once

#include "core/base/host_array.h"
#include "core/kernel/base/atomics.h"
#include "core/kernel/guiding/guiding_field.h"
#include "core/kernel/guiding/placement_view.h"

namespace pl::test {

struct CosineLobeField : PlacementView {
    struct Location {
        std::int32_t volume = kNoVolume;

        PL_HD bool is_served() const { return volume != kNoVolume; }
    };
    struct Entry {
        std::int32_t volume = kNoVolume;
        Vec3f wi{0.0f};

        PL_HD bool is_trained() const { return volume != kNoVolume; }
    };

    static constexpr float kExponent = 4.0f;
    static constexpr float kStepsPerUnit = 65536.0f;
    static constexpr float kMostTarget = 65536.0f;

    Span<const Vec3f> axis;                   ///< unit: mean direction of incident radiance. [volume]
    Span<const float> mean_radiance;          ///< irradiance / pi, luminance. [volume]
    Span<const float> mean_direct;            ///< the same by light samples. [volume]
    Span<std::int64_t> pending_direction;     ///< sum of target times wi, fixed point. [volume][3]
    Span<std::int64_t> pending_irradiance;    ///< sum of target cos / (pi q), fixed point. [volume]
    Span<std::uint32_t> pending_count;        ///< [volume]
    Span<std::int64_t> pending_direct;        ///< sum of irradiance / pi of light samples, fixed point. [volume]
    Span<std::uint32_t> pending_light_count;  ///< [volume]

    PL_HD Location locate(const SurfacePoint& surface) const { return {volume_at(surface)}; }

    /// cos^n around the axis: z = u^(1/(n+1)). Directions below the surface are zero-valued samples.
    PL_HD Vec3f sample(const Location& location, const SurfacePoint&, const ScatterNumbers& numbers) const {
        const float z = std::pow(numbers.u.y, 1.0f / (kExponent + 1.0f));
        const float radius = std::sqrt(max_of(0.0f, 1.0f - z * z));
        const float angle = 2.0f * kPi * numbers.u.z;
        return make_frame(axis_of(location)).to_world({radius * std::cos(angle), radius * std::sin(angle), z});
    }
    PL_HD FieldDensity density(const Location& location, const SurfacePoint&, Vec3f wi) const {
        const float cosine = glm::dot(axis_of(location), wi);
        if (!(cosine > 0.0f)) return {};
        return {(kExponent + 1.0f) * (0.5f * kInvPi) * std::pow(cosine, kExponent), 0};
    }
    PL_HD float bsdf_fraction_at(const Location&) const { return 0.5f; }
    PL_HD float value_at(const Location& location) const {
        return mean_radiance[static_cast<std::uint32_t>(location.volume)];
    }

    PL_HD float direct_at(const Location& location) const {
        return mean_direct[static_cast<std::uint32_t>(location.volume)];
    }

    PL_HD Entry entry_of(const Location& location, const DirectionSample& direction) const {
        return {location.volume, direction.wi};
    }
    PL_HD void record(const TrainingSample<CosineLobeField>& sample, bool) const {
        const auto volume = static_cast<std::uint32_t>(sample.entry.volume);
        const float target = min_of(sample.target, kMostTarget);
        for (int i = 0; i < 3; ++i)
            atomic_add(pending_direction[3 * volume + static_cast<std::uint32_t>(i)],
                       steps(target * sample.entry.wi[i]), Writers::Many);
        atomic_add(pending_irradiance[volume], steps(target * sample.bsdf_ratio), Writers::Many);
        atomic_add(pending_count[volume], 1u, Writers::Many);
    }
    PL_HD void add(const TrainingSample<CosineLobeField>& sample, bool) const {
        const auto volume = static_cast<std::uint32_t>(sample.entry.volume);
        atomic_add(pending_irradiance[volume], steps(sample.target * sample.bsdf_ratio), Writers::Many);
    }
    PL_HD LearnedLights lights_at(const Location&) const { return {}; }
    PL_HD void record_light(const LightSample<CosineLobeField>& light) const {
        const auto volume = static_cast<std::uint32_t>(light.location.volume);
        atomic_add(pending_direct[volume], steps(min_of(light.irradiance, kMostTarget)), Writers::Many);
        atomic_add(pending_light_count[volume], 1u, Writers::Many);
    }
    PL_HD bool is_clamped(float target) const { return target > kMostTarget; }

private:
    PL_HD Vec3f axis_of(const Location& location) const { return axis[static_cast<std::uint32_t>(location.volume)]; }
    static PL_HD std::int64_t steps(float value) { return static_cast<std::int64_t>(value * kStepsPerUnit); }
};
static_assert(GuidingField<CosineLobeField>);

/// The storage of its arrays, and the update.
struct CosineLobes {
    HostArray<Vec3f> axis;
    HostArray<float> mean_radiance, mean_direct;
    HostArray<std::int64_t> pending_direction, pending_irradiance, pending_direct;
    HostArray<std::uint32_t> pending_count, pending_light_count;

    explicit CosineLobes(const PlacementView& placement)
        : axis(placement.normals.begin(), placement.normals.end()), mean_radiance(axis.size(), 0.0f),
          mean_direct(axis.size(), 0.0f), pending_direction(3 * axis.size(), 0), pending_irradiance(axis.size(), 0),
          pending_direct(axis.size(), 0), pending_count(axis.size(), 0), pending_light_count(axis.size(), 0) {}

    CosineLobeField view(const PlacementView& placement) {
        CosineLobeField field;
        static_cast<PlacementView&>(field) = placement;
        field.axis = view_of(std::as_const(axis));
        field.mean_radiance = view_of(std::as_const(mean_radiance));
        field.mean_direct = view_of(std::as_const(mean_direct));
        field.pending_direction = view_of(pending_direction);
        field.pending_irradiance = view_of(pending_irradiance);
        field.pending_count = view_of(pending_count);
        field.pending_direct = view_of(pending_direct);
        field.pending_light_count = view_of(pending_light_count);
        return field;
    }

    /// Turns all training samples so far into the lobes of the next pass.
    void update() {
        for (std::size_t i = 0; i < axis.size(); ++i) {
            if (pending_light_count[i] > 0) mean_direct[i] = mean_of(pending_direct[i], pending_light_count[i]);
            if (pending_count[i] == 0) continue;
            const Vec3f sum{static_cast<float>(pending_direction[3 * i]),
                            static_cast<float>(pending_direction[3 * i + 1]),
                            static_cast<float>(pending_direction[3 * i + 2])};
            if (glm::dot(sum, sum) > 0.0f) axis[i] = glm::normalize(sum);
            mean_radiance[i] = mean_of(pending_irradiance[i], pending_count[i]);
        }
    }

private:
    static float mean_of(std::int64_t sum, std::uint32_t count) {
        return static_cast<float>(sum) / CosineLobeField::kStepsPerUnit / static_cast<float>(count);
    }
};

}  // namespace pl::test
