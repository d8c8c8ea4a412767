// Surfaces that do more than Lambert's law, one at a time.
#pragma once

#include <algorithm>

#include "core/kernel/shading/bsdf.h"
#include "core/scene/surface_info.h"
#include "tests/support/scenes/shapes.h"
#include "tests/support/statistics/sampling_rule.h"

namespace pl::test {

/// A unit direction above the horizon.
inline Vec3f random_above(Uniforms& random) {
    Vec3f direction = random.direction();
    direction.z = std::fabs(direction.z) + 1e-3f;
    return glm::normalize(direction);
}

/// A horizontal surface at the origin with one kind of lobes.
template <FeatureSet F>
class LobeSurfaceOf {
public:
    using Grain = typename Bsdf<F>::Grain;

    /// `albedo`: of the guided lobes, see pack_scene().
    explicit LobeSurfaceOf(const SurfaceLobes& lobes, Vec3f albedo = Vec3f{0.0f}, const Grain& grain = {})
        : lobes_(lobes), albedo_(albedo), grain_(grain) {
        if (const auto tables = surface_info(lobes.kind).tables) table_ = tables(lobes.ior);
    }

    static SurfacePoint point(bool front = true) {
        SurfacePoint point;
        point.front = front;
        return point;
    }
    Bsdf<F> from(Vec3f wo, bool front = true) const {
        return {point(front), wo, albedo_, lobes_, {table_.data(), static_cast<std::uint32_t>(table_.size())},
                grain_};
    }

private:
    SurfaceLobes lobes_;
    Vec3f albedo_;
    Grain grain_;
    std::vector<float> table_;
};
using LobeSurface = LobeSurfaceOf<kSurfaceFeatures.without(Feature::Anisotropy)>;
using BrushedSurface = LobeSurfaceOf<kSurfaceFeatures>;

/// Unit direction in the xz plane.
inline Vec3f tilted(float cos_theta) { return {std::sqrt(1.0f - cos_theta * cos_theta), 0.0f, cos_theta}; }

/// Cells of equal solid angle over the sphere.
struct SphereBins {
    static constexpr int kHeights = 24;
    static constexpr int kSectors = 24;
    static constexpr int kCount = kHeights * kSectors;

    static std::size_t of(Vec3f wi) {
        const int height = std::clamp(static_cast<int>((wi.z + 1.0f) * 0.5f * kHeights), 0, kHeights - 1);
        const float turn = std::atan2(wi.y, wi.x) * kInvPi * 0.5f + 0.5f;
        return static_cast<std::size_t>(height * kSectors +
                                        std::clamp(static_cast<int>(turn * kSectors), 0, kSectors - 1));
    }
    /// Integral of a density over each, by the midpoints of a fine grid.
    template <class Density>
    static std::vector<double> integrate(Density density) {
        constexpr int kFine = 64;
        std::vector<double> sums(kCount);
        for (int h = 0; h < kHeights * kFine; ++h)
            for (int s = 0; s < kSectors * kFine; ++s) {
                const double z = (h + 0.5) / (kHeights * kFine) * 2.0 - 1.0;
                const double angle = ((s + 0.5) / (kSectors * kFine) - 0.5) * 2.0 * 3.14159265358979323846;
                const double r = std::sqrt(1.0 - z * z);
                const Vec3f wi{Vec3d{r * std::cos(angle), r * std::sin(angle), z}};
                sums[static_cast<std::size_t>(h / kFine * kSectors + s / kFine)] += static_cast<double>(density(wi));
            }
        const double cell = 4.0 * 3.14159265358979323846 / (double{kCount} * kFine * kFine);
        for (double& sum : sums) sum *= cell;
        return sums;
    }
};

inline SurfaceLobes rough(SurfaceKind kind, float roughness) {
    return {.kind = kind, .roughness = roughness, .ior = 1.5f};
}

/// Samples that resolve a density off by `delta`.
struct SamplingTest {
    int samples;
    double delta;
};
inline constexpr SamplingTest kQuickSampling{250000, 0.06};
inline constexpr SamplingTest kFineSampling{1000000, 0.03};

/// S3 for the lobes of a surface; directions to the wrong side are left out of both.
template <FeatureSet F>
Decision check_sampling(const LobeSurfaceOf<F>& surface, Vec3f wo, bool front, SamplingTest test) {
    const Bsdf<F> bsdf = surface.from(wo, front);
    const SurfacePoint point = LobeSurface::point(front);
    const auto probabilities = SphereBins::integrate(
        [&](Vec3f wi) { return bsdf.cosine(point, wi) > 0.0f ? bsdf.pdf_sa(point, wi) : 0.0f; });
    std::vector<std::uint64_t> counts(SphereBins::kCount);
    Uniforms random(17);
    for (int i = 0; i < test.samples; ++i) {
        const Vec2f u = random.square();
        const Vec3f wi = bsdf.sample(point, u, random.next());
        if (bsdf.cosine(point, wi) > 0.0f && bsdf.pdf_sa(point, wi) > 0.0f) ++counts[SphereBins::of(wi)];
    }
    return sampler_matches(counts, probabilities, test.delta);
}
inline Decision check_sampling(const LobeSurface& surface, float cos_o, bool front, SamplingTest test) {
    return check_sampling(surface, tilted(cos_o), front, test);
}

/// Weights of samples: their mean is the reflectance for light from all directions.
template <FeatureSet F>
Moments returned_light(const LobeSurfaceOf<F>& surface, Vec3f wo, bool front, int samples) {
    const Bsdf<F> bsdf = surface.from(wo, front);
    const SurfacePoint point = LobeSurface::point(front);
    const double p = static_cast<double>(bsdf.delta_probability());
    Uniforms random(5);
    Moments weights;
    for (int i = 0; i < samples; ++i) {
        const float choice = random.next();
        const Vec2f u = random.square();
        double weight = 0.0;
        if (static_cast<double>(choice) < p) {
            weight = static_cast<double>(bsdf.sample_delta(point, random.next()).weight.x) / p;
        } else {
            const Vec3f wi = bsdf.sample(point, u, random.next());
            const float pdf_sa = bsdf.pdf_sa(point, wi);
            const float cos_i = bsdf.cosine(point, wi);
            if (pdf_sa > 0.0f && cos_i > 0.0f)
                weight = static_cast<double>(bsdf.eval(point, wi, cos_i).x) / static_cast<double>(pdf_sa) / (1.0 - p);
        }
        weights.add(weight);
    }
    return weights;
}

}  // namespace pl::test
