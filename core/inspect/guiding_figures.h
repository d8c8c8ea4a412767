// How far a volume's learned densities are from the light that reaches it: divergences, and the variance that sampling with them
// leaves. All of the probabilities of cells: the light within a cell counts as its mean.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/base/choice.h"
#include "core/inspect/incident_light.h"
#include "core/measure/statistics.h"
#include "core/session/settings.h"

namespace pl {

/// The part of incident radiance that a method's targets contain.
enum class TargetLight {
    All,          ///< all of it
    LeftByPaths,  ///< without what the guided mixture leaves to light samples by multiple importance sampling
    LeftByProbes  ///< the same with cosine sampling in place of the mixture
};
TargetLight target_light(const RenderSettings& settings, MethodId method);

template <>
inline constexpr auto kChoices<TargetLight> = std::to_array<ChoiceInfo<TargetLight>>({
    {TargetLight::All, "all", "all incident light"},
    {TargetLight::LeftByPaths, "left to paths", "left by light samples"},
    {TargetLight::LeftByProbes, "left to probes", "left by light samples"},
});

/// Probabilities that guided paths sample each cell with, delta lobes left out: a p_bsdf + (1 - a) p_field.
std::vector<float> mixture_shares(const IncidentLight& light, const VolumeInspection& volume);

/// Means over all paths. Luminances, [cell].
struct TrueLight {
    std::vector<float> radiance;        ///< incident
    std::vector<float> radiance_error;  ///< its standard error
    std::vector<float> target;          ///< the part that the method's targets contain
    std::vector<float> product;         ///< pi f L of that part: reflected towards wo
};

struct GuidingFigures {
    Interval table;    ///< Kullback-Leibler divergence of the learned probabilities from the target's, nats
    Interval mixture;  ///< divergence of mixture_shares() from the probabilities of the product, nats
    /// Variance of one direction's estimate of the reflected target by the mixture, over the variance by BSDF
    /// sampling; empty where BSDF sampling has no variance beyond its own error.
    std::optional<Interval> variance_factor;
};

/// All figures of one volume.
struct LightReport {
    std::uint64_t paths_per_cell = 0;
    std::uint64_t invalid_paths = 0;
    TargetLight target = TargetLight::All;
    TrueLight light;
    std::vector<float>
        product_shares;  ///< probabilities in proportion to the product: they leave no variance. [cell]
    std::vector<float> mixture_shares;  ///< see mixture_shares(). [cell]
    GuidingFigures figures;
};
/// light.has_all_groups(). `volume` may have been read at any time.
LightReport report_light(const IncidentLight& light, const VolumeInspection& volume, TargetLight target);

/// Light compared with densities. `volume` has been read at any time after or before the paths were traced.
class LightComparison {
public:
    /// light.has_all_groups().
    LightComparison(const IncidentLight& light, const VolumeInspection& volume, TargetLight target);

    TrueLight true_light() const;
    GuidingFigures figures() const;
    /// Probabilities of the product, the density that leaves no variance.
    std::vector<float> product_shares() const;
    const std::vector<float>& mixture() const { return mixture_; }

private:
    std::size_t cells_;
    std::vector<float> table_;
    std::vector<float> mixture_;
    std::vector<float> bsdf_;
    std::vector<double> radiance_;  ///< mean of each group. [group][cell]
    std::vector<double> target_;
    std::vector<double> product_;
};

}  // namespace pl
