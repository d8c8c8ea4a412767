// Progress of a rendering: a bar on a terminal, else a line every few seconds, else events.
#pragma once

#include <string>

#include "app/console.h"
#include "core/base/progress.h"
#include "core/base/timer.h"

namespace pl {

/// Grants one message per interval, the first at the end of the first interval.
class MessagePace {
public:
    explicit MessagePace(double interval_seconds) : interval_(interval_seconds), next_(interval_seconds) {}
    /// Whether a message is due `elapsed` seconds after the start; the next one is due an interval later.
    bool is_due(double elapsed);

private:
    double interval_;
    double next_;
};

/// Shows progress as often as its medium can take it.
class ProgressDisplay {
public:
    ProgressDisplay(Console& console, bool enabled);
    ~ProgressDisplay();
    ProgressDisplay(const ProgressDisplay&) = delete;
    ProgressDisplay& operator=(const ProgressDisplay&) = delete;

    void show(const ProgressState& state);
    /// Takes the bar off the terminal.
    void clear() { console_.log().clear_status(); }

private:
    Console& console_;
    bool enabled_;
    Stopwatch watch_;
    MessagePace pace_;
};

/// "[#######       ] text", at most `width` characters.
std::string progress_bar(double share, const std::string& text, int width);
}  // namespace pl
