#include "app/progress.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace pl {
namespace {

constexpr double kBarSeconds = 0.1;
constexpr double kEventSeconds = 1.0;
constexpr double kLineSeconds = 5.0;

/// Time left at the pace so far; empty while that is unreliable.
std::string time_left(double share, double elapsed) {
    if (share < 0.01 || elapsed < 1.0 || share >= 1.0) return "";
    return fmt::format(", {} left", duration_text(elapsed * (1.0 - share) / share));
}

double interval_of(Console& console) {
    if (console.json()) return kEventSeconds;
    return console.log().is_terminal() ? kBarSeconds : kLineSeconds;
}

}  // namespace

ProgressDisplay::ProgressDisplay(Console& console, bool enabled)
    : console_(console), enabled_(enabled), pace_(interval_of(console)) {}

ProgressDisplay::~ProgressDisplay() { clear(); }

bool MessagePace::is_due(double elapsed) {
    if (elapsed < next_) return false;
    next_ = elapsed + interval_;
    return true;
}

void ProgressDisplay::show(const ProgressState& state) {
    const double elapsed = watch_.seconds();
    if (!enabled_ || !pace_.is_due(elapsed)) return;
    if (console_.json()) {
        console_.event("progress", {{"run", 1},
                                    {"activity", state.activity},
                                    {"share", state.share},
                                    {"spp", state.spp},
                                    {"t_render", elapsed},
                                    {"error", nullptr}});
        return;
    }
    const std::string text = fmt::format("{} {:3.0f} %, {}{}", state.activity, std::floor(100.0 * state.share),
                                         state.detail, time_left(state.share, elapsed));
    if (console_.log().is_terminal())
        console_.log().show_status(progress_bar(state.share, text, console_.log().terminal_width() - 1));
    else
        console_.log().notice(text);
}

std::string progress_bar(double share, const std::string& text, int width) {
    const auto room = static_cast<std::size_t>(std::max(width, 0));
    if (room < text.size() + 13)  // a bar of less than ten characters shows nothing
        return text.substr(0, room);
    const std::size_t length = std::min<std::size_t>(room - text.size() - 3, 40);
    const double filled = std::clamp(share, 0.0, 1.0) * static_cast<double>(length);
    std::string bar(length, ' ');
    std::fill_n(bar.begin(), static_cast<std::size_t>(filled), '#');
    return fmt::format("[{}] {}", bar, text);
}

}  // namespace pl
