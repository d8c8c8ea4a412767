// Which of two methods renders next, where they share a machine in turns of equal time.
#pragma once

#include <array>
#include <cstddef>

namespace pl {

/// Order A, B, B, A, so that a clock or a machine that drifts affects both alike. The turns equalize charged time: a
/// pass that takes longer than a turn is paid for with later ones.
class Turns {
public:
    explicit Turns(double turn_seconds) : turn_seconds_(turn_seconds) {}

    /// The side to go on with, 0 or 1, given the seconds that each was charged so far. The side that is behind at first
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

}  // namespace pl
