// One result of the self test, for display on a command line or in a window.
#pragma once

#include <string>

namespace pl {

/// One scene, one way of rendering it, one value with its expected value.
struct SelfCheck {
    std::string backend;    ///< "cpu"
    std::string name;       ///< "lamp over a floor: reinforcement"
    std::string criterion;  ///< the condition, in words
    double expected = 0.0;
    double measured = 0.0;
    double tolerance = 0.0;   ///< largest difference of the two; 0: they have to be equal
    double used_share = 0.0;  ///< difference over tolerance; without tolerance 0 if the check passes, else infinite
    bool passed = false;
    double seconds = 0.0;
};

}  // namespace pl
