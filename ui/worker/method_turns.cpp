#include "ui/worker/method_turns.h"

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

void MethodTurns::count(std::size_t side, const Session& session, View view) {
    const FilmSlot slot{status_.sides.methods[side], view};
    status_.passes[side] = session.passes(slot);
    status_.seconds[side] = work_seconds(session.clocks(slot));
    if (side == 0) field_ = session.field_status(slot.method);
}

std::optional<std::size_t> MethodTurns::side_at_limit(const Requests& now) const {
    for (const std::size_t side : {0u, 1u}) {
        if (!now.is_enough(status_.passes[side], status_.seconds[side])) continue;
        const std::size_t other = 1 - side;
        const bool has_had_its_time = status_.seconds[other] >= status_.seconds[side] && status_.passes[other] > 0;
        const bool is_behind = !has_had_its_time && !now.is_enough(status_.passes[other], status_.seconds[other]);
        return is_behind ? other : side;
    }
    return std::nullopt;
}

bool MethodTurns::limit_reached(const Requests& now) const {
    const auto side = side_at_limit(now);
    return side && now.is_enough(status_.passes[*side], status_.seconds[*side]);
}

std::size_t MethodTurns::next(bool is_moving, const Requests& now) {
    const auto limited = side_at_limit(now);
    const std::size_t side = is_moving ? 0 : (limited ? *limited : order_.next(status_.seconds));
    status_.catching_up = order_.catching_up();
    return side;
}

}  // namespace pl::ui
