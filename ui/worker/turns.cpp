#include "ui/worker/turns.h"

#include <algorithm>

namespace pl::ui {
namespace {

constexpr std::array<std::size_t, 4> kOrder{0, 1, 1, 0};

}  // namespace

std::size_t Turns::next(const std::array<double, 2>& charged_seconds) {
    const bool starts_over = charged_seconds[0] < seen_[0] || charged_seconds[1] < seen_[1];
    if (!started_ || starts_over) {
        started_ = true;
        catching_up_ = charged_seconds[0] != charged_seconds[1];
        goal_.fill(std::max(charged_seconds[0], charged_seconds[1]));
        turn_ = kOrder.size() - 1;  // the next turn is the first
    }
    seen_ = charged_seconds;
    if (catching_up_) {
        for (const std::size_t side : {0u, 1u})
            if (charged_seconds[side] < goal_[side]) return side;
        catching_up_ = false;
    }
    while (!(charged_seconds[kOrder[turn_]] < goal_[kOrder[turn_]])) {
        turn_ = (turn_ + 1) % kOrder.size();
        goal_[kOrder[turn_]] += turn_seconds_;
    }
    return kOrder[turn_];
}

}  // namespace pl::ui
