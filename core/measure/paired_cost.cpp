#include "core/measure/paired_cost.h"

namespace pl {

void PairedCost::add(double seconds) {
    if (!is_second_) {
        first_seconds_ = seconds;
        is_second_ = true;
        return;
    }
    is_second_ = false;
    if (is_warm_ && !done()) {
        base_.push_back(other_first_ ? seconds : first_seconds_);
        other_.push_back(other_first_ ? first_seconds_ : seconds);
    }
    is_warm_ = true;
    other_first_ = !other_first_;
}

PairedCost::Result PairedCost::result() const {
    if (base_.empty()) return {};
    std::vector<double> ratios;
    for (std::size_t i = 0; i < base_.size(); ++i) ratios.push_back(other_[i] / base_[i]);
    return {.pairs = base_.size(),
            .base_seconds = geometric_interval(base_).value,
            .other_seconds = geometric_interval(other_).value,
            .ratio = geometric_interval(ratios)};
}

}  // namespace pl
