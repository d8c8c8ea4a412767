#include "core/fields/mixture_fit.h"

#include <algorithm>
#include <cmath>

namespace pl {
namespace {

/// The integral of a b / c over all directions.
double ratio_integral(const VmfLobe& a, const VmfLobe& b, const VmfLobe& c) {
    const Vec3f sum = a.kappa * a.mean + b.kappa * b.mean - c.kappa * c.mean;
    const float kappa = glm::length(sum);
    const double peaks = static_cast<double>(vmf_peak(a.kappa)) * static_cast<double>(vmf_peak(b.kappa)) /
                         (static_cast<double>(vmf_peak(c.kappa)) * static_cast<double>(vmf_peak(kappa)));
    return peaks * std::exp(static_cast<double>(kappa - a.kappa - b.kappa + c.kappa));
}

std::array<float, kLobeMoments> scaled(std::array<float, kLobeMoments> moments, float factor) {
    for (float& moment : moments) moment *= factor;
    return moments;
}

Vec3f direction_of(const std::array<float, kLobeMoments>& moments) {
    return {moments[kMomentX], moments[kMomentY], moments[kMomentZ]};
}

/// The tangent axis along which a lobe's directions spread most, and their variance along it.
struct Spread {
    Vec3f axis;
    float variance;
};
Spread widest_spread(const FittedLobe& lobe) {
    const auto& m = lobe.moments;
    const float zz = m[kMomentWeight] - m[kMomentXx] - m[kMomentYy];
    const auto times = [&](Vec3f v) {
        return Vec3f{m[kMomentXx] * v.x + m[kMomentXy] * v.y + m[kMomentXz] * v.z,
                     m[kMomentXy] * v.x + m[kMomentYy] * v.y + m[kMomentYz] * v.z,
                     m[kMomentXz] * v.x + m[kMomentYz] * v.y + zz * v.z} /
               m[kMomentWeight];
    };
    const Frame frame = make_frame(lobe.lobe.mean);
    const float a = glm::dot(frame.x, times(frame.x));
    const float b = glm::dot(frame.x, times(frame.y));
    const float c = glm::dot(frame.y, times(frame.y));
    const float half = 0.5f * (a - c);
    const float angle = 0.5f * std::atan2(b, half);
    return {std::cos(angle) * frame.x + std::sin(angle) * frame.y, 0.5f * (a + c) + std::sqrt(half * half + b * b)};
}

}  // namespace

float merge_misfit(const FittedLobe& a, const FittedLobe& b, const VmfLobe& merged) {
    const double wa = static_cast<double>(a.weight);
    const double wb = static_cast<double>(b.weight);
    const double both = wa + wb;
    if (!(both > 0.0)) return 0.0f;
    const double squares = wa * wa * ratio_integral(a.lobe, a.lobe, merged) +
                           wb * wb * ratio_integral(b.lobe, b.lobe, merged) +
                           2.0 * wa * wb * ratio_integral(a.lobe, b.lobe, merged);
    const double misfit = squares / both - both;
    return misfit < static_cast<double>(kInfinity) ? static_cast<float>(misfit) : kInfinity;
}

MixtureFit::MixtureFit(const HostLobes& lobes, std::uint32_t volume, double samples)
    : count_(lobes.lobe_count[volume]), volume_(volume), samples_(samples) {
    for (std::size_t i = 0; i < count_; ++i) {
        const std::size_t lobe = volume * kMostLobes + i;
        FittedLobe& fitted = lobes_[i];
        std::copy_n(&lobes.moments[lobe * kLobeMoments], kLobeMoments, fitted.moments.begin());
        fitted.lobe = {{lobes.mean[3 * lobe], lobes.mean[3 * lobe + 1], lobes.mean[3 * lobe + 2]}, lobes.kappa[lobe]};
        fitted.weight = lobes.weight[lobe];
        fitted.inverse_distance = lobes.inverse_distance[lobe];
        fitted.age = lobes.age[lobe];
    }
}

void MixtureFit::absorb(HostLobes& lobes, float radiance_unit, std::uint32_t fresh, float step) {
    for (std::size_t i = 0; i < count_; ++i) {
        std::int64_t* sums = &lobes.pending_moments[(volume_ * kMostLobes + i) * kLobeMoments];
        for (std::uint32_t m = 0; m < kLobeMoments; ++m) {
            const double unit = m < kMomentSquare ? static_cast<double>(radiance_unit) : 1.0;
            const double mean = static_cast<double>(sums[m]) / static_cast<double>(steps_of(m)) / fresh * unit;
            float& moment = lobes_[i].moments[m];
            moment += step * (static_cast<float>(mean) - moment);
            sums[m] = 0;
        }
        ++lobes_[i].age;
    }
}

bool MixtureFit::fit() {
    total_ = 0.0f;
    for (std::size_t i = 0; i < count_; ++i) total_ += lobes_[i].moments[kMomentWeight];
    if (!(total_ > 0x1p-100f) || !(total_ < kInfinity)) return false;
    for (std::size_t i = 0; i < count_; ++i) fit_lobe(lobes_[i]);
    fit_weights();
    split_worst();
    merge_nearest();
    fit_weights();
    return true;
}

/// Number of equally bright samples that would say as much as the samples of the lobe. Unknown before the second
/// update, which is the first to know the mean weight: then a tenth of the number of samples.
float MixtureFit::effective_samples(const FittedLobe& lobe) const {
    constexpr double kUnknown = 0.1;
    const auto share = static_cast<double>(share_of(lobe));
    const auto square = static_cast<double>(lobe.moments[kMomentSquare]);
    const double all = samples_ * share;
    return static_cast<float>(square > 0.0 ? std::min(all * share / square, samples_) : kUnknown * all);
}

void MixtureFit::fit_lobe(FittedLobe& fitted) const {
    const float weight = fitted.moments[kMomentWeight];
    const Vec3f direction = direction_of(fitted.moments);
    const float length = glm::length(direction);
    if (!(weight > 0.0f) || !(length > 0.0f)) {
        fitted.lobe.kappa = 0.0f;
        return;
    }
    const float samples = effective_samples(fitted);
    const float mean_cosine = min_of(length / weight, 1.0f) * (samples / (samples + kMeanCosinePrior));
    fitted.lobe = {direction / length, vmf_kappa(mean_cosine)};
    fitted.inverse_distance = clamp_to(fitted.moments[kMomentInverse] / weight, 0.0f, kMostInverseDistance);
}

void MixtureFit::fit_weights() {
    float samples = 0.0f;
    for (std::size_t i = 0; i < count_; ++i) samples += effective_samples(lobes_[i]);
    const float all = samples + kWeightPrior * static_cast<float>(count_);
    for (std::size_t i = 0; i < count_; ++i) lobes_[i].weight = (share_of(lobes_[i]) * samples + kWeightPrior) / all;
}

/// The chi-square of a lobe: its part of the integral of (f - v)^2 / v, f the normalized radiance and v the mixture.
void MixtureFit::split_worst() {
    const std::size_t before = count_;
    std::array<std::pair<float, std::size_t>, kMostLobes> misfits;
    for (std::size_t i = 0; i < before; ++i) misfits[i] = {lobes_[i].moments[kMomentMisfit] - share_of(lobes_[i]), i};
    std::sort(misfits.begin(), misfits.begin() + static_cast<std::ptrdiff_t>(before),
              [](const auto& a, const auto& b) {
                  return a.first > b.first || (a.first == b.first && a.second < b.second);
              });
    for (std::size_t k = 0; k < before && count_ < kMostLobes && misfits[k].first > kSplitMisfit; ++k) {
        const FittedLobe& lobe = lobes_[misfits[k].second];
        if (lobe.age >= kSettled && effective_samples(lobe) >= kFewestToSplit) split(misfits[k].second);
    }
}

/// Two lobes of half the weight, apart by the square root of twice the variance along the axis of greatest variance:
/// they keep half of this variance, and their moments add up to the moments of the lobe that is split.
void MixtureFit::split(std::size_t i) {
    const FittedLobe whole = lobes_[i];
    const Spread spread = widest_spread(whole);
    const float offset = std::sqrt(0.5f * max_of(spread.variance, 0.0f));
    const float length = 0.5f * glm::length(direction_of(whole.moments));
    const float side[2] = {offset, -offset};
    for (std::size_t k = 0; k < 2; ++k) {
        FittedLobe& half = k == 0 ? lobes_[i] : lobes_[count_];
        half = whole;
        half.moments = scaled(whole.moments, 0.5f);
        Vec3f direction = length * (whole.lobe.mean + side[k] * spread.axis);
        direction *= min_of(1.0f, half.moments[kMomentWeight] / max_of(glm::length(direction), 1.0e-30f));
        half.moments[kMomentX] = direction.x;
        half.moments[kMomentY] = direction.y;
        half.moments[kMomentZ] = direction.z;
        half.moments[kMomentMisfit] = share_of(half);
        half.age = 0;
        fit_lobe(half);
    }
    ++count_;
}

void MixtureFit::merge_nearest() {
    float least = kMergeMisfit;
    std::size_t first = 0;
    std::size_t second = 0;
    FittedLobe best;
    for (std::size_t i = 0; i < count_; ++i)
        for (std::size_t k = i + 1; k < count_; ++k) {
            if (lobes_[i].age < kSettled || lobes_[k].age < kSettled) continue;
            FittedLobe merged = lobes_[i];
            for (std::uint32_t m = 0; m < kLobeMoments; ++m) merged.moments[m] += lobes_[k].moments[m];
            fit_lobe(merged);
            const float misfit = merge_misfit(lobes_[i], lobes_[k], merged.lobe);
            if (!(misfit < least)) continue;
            least = misfit;
            first = i;
            second = k;
            best = merged;
        }
    if (first == second) return;
    best.age = 0;
    lobes_[first] = best;
    lobes_[second] = lobes_[--count_];
}

void MixtureFit::store(HostLobes& lobes) const {
    lobes.lobe_count[volume_] = static_cast<std::uint32_t>(count_);
    lobes.total[volume_] = total_;
    for (std::size_t i = 0; i < kMostLobes; ++i) {
        const std::size_t lobe = volume_ * kMostLobes + i;
        const FittedLobe fitted = i < count_ ? lobes_[i] : FittedLobe{};
        std::copy(fitted.moments.begin(), fitted.moments.end(), &lobes.moments[lobe * kLobeMoments]);
        for (int axis = 0; axis < 3; ++axis)
            lobes.mean[3 * lobe + static_cast<std::size_t>(axis)] = fitted.lobe.mean[axis];
        lobes.kappa[lobe] = fitted.lobe.kappa;
        lobes.weight[lobe] = fitted.weight;
        lobes.inverse_distance[lobe] = fitted.inverse_distance;
        lobes.age[lobe] = fitted.age;
    }
}

}  // namespace pl
