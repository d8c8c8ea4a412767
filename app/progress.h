// How far a rendering is: a bar on a terminal, else a line every few seconds, else events.
#pragma once

#include <string>

#include "app/console.h"
#include "core/base/timer.h"

namespace pl {

/// A moment of a rendering.
struct ProgressState {
    std::string activity;   ///< "rendering", "precomputing"
    double share = 0.0;     ///< of the whole, in [0, 1]
    std::uint32_t spp = 0;  ///< samples per pixel so far
    std::string detail;     ///< "12/64 spp, 3.1 M segments/s"
};

/// Grants one message in every interval, the first one at the end of the first interval.
class MessagePace {
public:
    explicit MessagePace(double interval_seconds) : interval_(interval_seconds), next_(interval_seconds) {}
    /// Whether a message is due `elapsed` seconds after the start; the next one is then due an interval later.
    bool is_due(double elapsed);

private:
    double interval_;
    double next_;
};

/// Shows what it is given as often as its medium can take it.
class ProgressDisplay {
public:
    ProgressDisplay(Console& console, bool enabled);
    ~ProgressDisplay();
    ProgressDisplay(const ProgressDisplay&) = delete;
    ProgressDisplay& operator=(const ProgressDisplay&) = delete;

    void show(const ProgressState& state);

private:
    Console& console_;
    bool enabled_;
    Stopwatch watch_;
    MessagePace pace_;
};

/// "[#######       ] text", at most `width` characters.
std::string progress_bar(double share, const std::string& text, int width);

/// "12 s", "3:05 min", "2:10 h".
std::string duration_text(double seconds);

}  // namespace pl
