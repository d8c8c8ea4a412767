// How far a long piece of work has come, for whoever shows it: a terminal, a window, a log.
#pragma once

#include <cstdint>
#include <string>

namespace pl {

/// One moment of the work.
struct ProgressState {
    std::string activity;   ///< "rendering", "precomputing"
    double share = 0.0;     ///< of the whole, in [0, 1]
    std::uint32_t spp = 0;  ///< samples per pixel so far
    std::string detail;     ///< "12/64 spp, 3.1 M segments/s"
};

/// "12 s", "3:05 min", "2:10 h".
std::string duration_text(double seconds);

}  // namespace pl
