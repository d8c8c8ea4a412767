// One result of the self test, as a command line or a window shows it.
#pragma once

#include <string>

namespace pl {

/// One scene, one way to render it, and one number with its expected value.
struct SelfCheck {
    std::string backend;    ///< "cpu"
    std::string name;       ///< "lamp over a floor: reinforcement"
    std::string criterion;  ///< in words
    double expected = 0.0;
    double measured = 0.0;
    double tolerance = 0.0;   ///< largest allowed difference; 0: they have to be equal
    double used_share = 0.0;  ///< of the tolerance; of checks without tolerance 0 if they hold, else infinite
    bool passed = false;
    double seconds = 0.0;
};

}  // namespace pl
