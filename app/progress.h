// Progress of a rendering: a bar on a terminal, else a line every few seconds, else events.
#pragma once

#include <string>

#include "app/console.h"
#include "core/base/progress.h"
#include "core/base/timer.h"

namespace pl {

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
    double interval_seconds() const;

    Console& console_;
    bool enabled_;
    Stopwatch watch_;
    double next_seconds_;
};

/// "[#######       ] text", at most `width` characters.
std::string progress_bar(double share, const std::string& text, int width);
}  // namespace pl
