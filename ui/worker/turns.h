// The order of two methods that share a machine in turns of equal time.
#pragma once

#include <array>
#include <cstddef>

namespace pl::ui {

/// Order A, B, B, A, so that a drifting clock or machine affects both alike. The turns equalize charged time: a pass
/// longer than a turn shortens later ones.
class Turns {
public:
    explicit Turns(double turn_seconds) : turn_seconds_(turn_seconds) {}

    /// The side that continues, 0 or 1, given the seconds charged to each so far. The side that is behind at first
    /// catches up before turns begin; so it does again after a side starts over.
    std::size_t next(const std::array<double, 2>& charged_seconds);

    /// One side works alone until both were charged the same.
    bool catching_up() const { return catching_up_; }

private:
    double turn_seconds_;
    std::array<double, 2> goal_{};  ///< charged seconds at the end of the present turn of each
    std::array<double, 2> seen_{};
    std::size_t turn_ = 0;
    bool started_ = false;
    bool catching_up_ = false;
};

}  // namespace pl::ui
