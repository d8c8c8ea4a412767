// Two runs in turns of equal charged time: passes, seconds and limits of both, and whose turn it is.
#pragma once

#include <array>
#include <cstddef>

#include "core/session/session.h"
#include "ui/worker/requests.h"

namespace pl::ui {

// The order of two runs that share a machine in turns of equal time.

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

class MethodTurns {
public:
    static constexpr double kTurnSeconds = 0.25;

    explicit MethodTurns(const TurnSides& sides) { status_.sides = sides; }

    const TurnsStatus& status() const { return status_; }
    MethodId first() const { return status_.sides.methods[0]; }
    /// Of the first side, when it was last counted.
    const std::optional<FieldStatus>& field() const { return field_; }

    /// Reads passes and seconds of a side from its session, since edits may have emptied its film.
    void count(std::size_t side, const Session& session, View view);

    /// The side that decides about limits. Once one side has met a limit, the other one decides, until it has had the same time and a pass; then the first one again. Empty before.
    std::optional<std::size_t> side_at_limit(const Requests& now) const;
    bool limit_reached(const Requests& now) const;

    /// The side that continues. While the camera moves it is the first one alone: the picture follows as quickly
    /// as without turns.
    std::size_t next(bool is_moving, const Requests& now);
    std::size_t side() const { return side_; }
    void set_side(std::size_t side) { side_ = side; }

private:
    TurnsStatus status_;
    Turns order_{kTurnSeconds};
    std::size_t side_ = 0;
    std::optional<FieldStatus> field_;
};

}  // namespace pl::ui
