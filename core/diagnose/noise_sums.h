// The variance of a pixel's estimate, divided among techniques, bounces and lights.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/diagnose/contributions.h"
#include "core/measure/gain.h"
#include "core/measure/jackknife.h"

namespace pl::diagnose {

/// Bounces are told apart up to one less; the last class has all others.
inline constexpr std::size_t kBounceClasses = 9;

/// Shares of the variance of one path's luminance T. That of a part C, the sum of the contributions of one kind, is Cov(C, T) / Var(T):
/// its own variance, and half of its covariances with each of the other parts. The shares of each array sum to 1; one is negative
/// if its part makes up for others.
struct NoiseShares {
    std::array<Interval, kFoundByCount> found_by{};
    std::array<Interval, kBounceClasses> bounces{};
    std::array<Interval, 2> lights{};  ///< of surfaces, of environment and sun
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
    static constexpr std::size_t kClasses = kFoundByCount + kBounceClasses + 2;

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

/// Gain of a method at this pixel, path by path: variances and processor time of its paths against those of the baseline. The jackknife
/// leaves out the same groups of both. Empty if one of the two has no variance.
std::optional<Gain> pixel_gain(const NoiseSums& base, const NoiseSums& method);

}  // namespace pl::diagnose
