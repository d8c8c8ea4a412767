// The noise of a pixel by technique and bounces.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/diagnose/pixel_paths.h"
#include "core/diagnose/record_path.h"
#include "core/measure/gain.h"
#include "core/measure/statistics.h"

namespace pl::diagnose {

// The parts of a path's radiance: the technique that found each, its bounces, and its light.

struct Contribution {
    Technique found_by = Technique::Camera;
    std::uint32_t bounces = 0;  ///< scattering events between the light and the camera: 0 if it is seen directly
    bool is_distant = false;    ///< of the environment or a sun, not of a surface
    double light = 0.0;         ///< luminance brought to the pixel
};

/// All contributions that are not black. Their sum is the luminance of PathRecord::radiance, up to rounding.
std::vector<Contribution> contributions_of(const PathRecord& path);

// The variance of a pixel's estimate, divided among techniques, bounces and lights.

/// Bounces are told apart up to one less; the last class has all others.
inline constexpr std::size_t kBounceClasses = 9;
/// "3", "8 or more".
std::string bounce_name(std::size_t bounces);
/// The parts of NoiseShares::lights.
inline constexpr std::array kNoiseLights = {"surfaces", "environment"};

/// Shares of the variance of one path's luminance T. The share of a part C, the sum of the contributions of one kind,
/// is Cov(C, T) / Var(T): its own variance, and half of its covariances with each of the other parts. The shares of
/// each array sum to 1; one is negative if its part makes up for others.
struct NoiseShares {
    std::array<Interval, kTechniqueCount> found_by{};
    std::array<Interval, kBounceClasses> bounces{};
    std::array<Interval, kNoiseLights.size()> lights{};  ///< of surfaces, of environment and sun
};

/// Of one method at one pixel. Luminances.
struct PixelEstimate {
    std::uint64_t paths = 0;
    Interval mean{};
    Interval variance{};                  ///< of one path
    double seconds_per_path = 0.0;        ///< processor time
    std::optional<NoiseShares> shares{};  ///< none without variance
};

/// Sums over paths, dealt to groups in turn.
class NoiseSums {
public:
    /// `group` below kJackknifeGroups.
    void add(std::size_t group, std::span<const Contribution> path);
    void add_seconds(std::size_t group, double seconds) { groups_[group].seconds += seconds; }

    /// Whether every group has a path, before which there are no estimates.
    bool has_all_groups() const;
    PixelEstimate estimate() const;

    double mean(GroupSet set) const;
    double variance(GroupSet set) const;
    double seconds_per_path(GroupSet set) const;

private:
    static constexpr std::size_t kClasses = kTechniqueCount + kBounceClasses + kNoiseLights.size();

    struct Sums {
        double paths = 0.0;
        double total = 0.0;
        double square = 0.0;
        double seconds = 0.0;
        std::array<double, kClasses> parts{};     ///< C
        std::array<double, kClasses> products{};  ///< C T

        Sums& operator+=(const Sums& other);
    };
    Sums sum(GroupSet set) const;
    Interval share(std::size_t part) const;

    std::array<Sums, kJackknifeGroups> groups_{};
};

/// Gain of a method at this pixel, path by path: variance and processor time of its paths against variance and
/// processor time of the baseline's paths. The jackknife leaves out the same groups of both. Empty if one of the two
/// has no variance.
std::optional<Gain> pixel_gain(const NoiseSums& base, const NoiseSums& method);

// "Why this pixel?": the noise of a pixel by technique and bounce, and the gain of guidance there, by paths of both methods in turns.

struct PixelNoise {
    std::uint32_t pixel = 0;  ///< row-major
    PixelEstimate plain;
    std::optional<PixelEstimate>
        guided{};  ///< every path guided, whether the picture is or not; empty without a field
    MethodId guided_method = MethodId::Reinforcement;  ///< of `guided`
    std::optional<Gain> gain{};                        ///< of guidance; see pixel_gain()
};

/// Traces paths of one pixel that belong to no pass of the picture, so that they are independent of it and of what the field has
/// learned. The field comes from the replay. The same paths give the same figures, except their time.
class PixelNoiseTracer {
public:
    PixelNoiseTracer(PassPair passes, std::uint32_t pixel);
    PixelNoiseTracer(const PixelNoiseTracer&) = delete;
    PixelNoiseTracer& operator=(const PixelNoiseTracer&) = delete;

    /// A step: as many paths by each method into one group. They are traced twice: by the kernel's own loop for their time, without
    /// training the field, and again with a record of their vertices. Returns false if `stop` was raised before.
    static constexpr std::uint32_t kPathsPerStep = 8;
    bool advance(const StopFlag* stop = nullptr);

    std::uint32_t paths() const { return steps_ * kPathsPerStep; }
    /// Before every group has paths there is no noise().
    bool has_all_groups() const { return plain_.has_all_groups(); }
    PixelNoise noise() const;

private:
    void trace(const PassReplay& passes, const AnyFieldView& field, NoiseSums& sums) const;

    PassPair passes_;
    AnyFieldView field_;  ///< of passes_.guided
    std::uint32_t pixel_;
    std::uint32_t steps_ = 0;
    NoiseSums plain_;
    NoiseSums guided_;
};

}  // namespace pl::diagnose
