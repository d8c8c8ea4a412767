#include "core/plot/log_axis.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace pl {
namespace {

constexpr double kMargin = 1.08;  ///< factor on both sides

struct Step {
    int digits;  ///< 1: labels at 1 only; 3: at 1, 2 and 5
    int powers;  ///< between labeled powers of ten
};

bool is_labeled(int digit, int power, const Step& step) {
    const bool chosen = digit == 1 || (step.digits > 1 && (digit == 2 || digit == 5));
    return chosen && power % step.powers == 0;
}

}  // namespace

LogAxis::LogAxis(double low, double high, double margin) : low_(low / margin), high_(high * margin) {
    if (std::isfinite(low_) && std::isfinite(high_) && low > 0.0 && low_ < high_ && low <= high) return;
    low_ = 1.0 / std::sqrt(10.0);
    high_ = std::sqrt(10.0);
}

LogAxis::LogAxis(double low, double high) : LogAxis(low, high, kMargin) {}

LogAxis LogAxis::exactly(double low, double high) { return {low, high, 1.0}; }

double LogAxis::position(double value) const { return std::log(value / low_) / std::log(high_ / low_); }

double LogAxis::value_at(double position) const { return low_ * std::pow(high_ / low_, position); }

std::vector<AxisTick> LogAxis::ticks(int most_labels) const {
    const int first = static_cast<int>(std::floor(std::log10(low_)));
    const int last = static_cast<int>(std::ceil(std::log10(high_)));
    for (Step step{3, 1};; step = step.digits > 1 ? Step{1, 1} : Step{1, step.powers + 1}) {
        std::vector<AxisTick> ticks;
        int labels = 0;
        for (int power = first; power <= last; ++power)
            for (int digit = 1; digit <= 9; ++digit) {
                const double value = digit * std::pow(10.0, power);
                if (value < low_ || value > high_) continue;
                const bool labeled = is_labeled(digit, power, step);
                labels += labeled ? 1 : 0;
                ticks.push_back({value, labeled ? tick_label(value) : ""});
            }
        if (labels <= std::max(most_labels, 1)) return ticks;
    }
}

std::string tick_label(double value) { return fmt::format("{:.3g}", value); }

}  // namespace pl
