// Camera paths per second of rendering, over intervals of half a second of the render clock.
#pragma once

#include <string>

#include "core/session/snapshot.h"

namespace pl::ui {

class Throughput {
public:
    static constexpr double kIntervalSeconds = 0.5;

    /// A newer snapshot of a film, rendered by this back end. Another film, or one that was cleared, starts over.
    void observe(const Snapshot& snapshot, const std::string& backend);

    /// Million camera paths per second; 0 before the first pass.
    double mpaths_per_second() const { return mpaths_per_second_; }

private:
    double mpaths_per_second_ = 0.0;
    FilmSlot slot_;
    std::string backend_;
    std::uint64_t paths_ = 0;  ///< at the start of the interval
    double seconds_ = 0.0;     ///< on the render clock, at the start of the interval
};

}  // namespace pl::ui
