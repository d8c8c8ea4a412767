#include "ui/worker/method_turns.h"

namespace pl::ui {

void MethodTurns::count_both(const Session& session, View view) {
    for (const std::size_t side : {0u, 1u}) count_side(side, session, view);
}

void MethodTurns::count_side(std::size_t side, const Session& session, View view) {
    const FilmSlot slot{status_.methods[side], view};
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
