// Keeps the time for measuring a small share of the measured time.
#pragma once

namespace pl {

/// Seconds spent on measuring, compared with the seconds charged to the runs.
class MeasureBudget {
public:
    static constexpr double kDefaultShare = 0.01;

    /// An infinite share allows everything.
    explicit MeasureBudget(double share = kDefaultShare) : share_(share) {}

    /// Whether so many more measurements, each as long as the last one, keep within the share.
    bool allows(double charged_seconds, int measurements = 1) const {
        return !(spent_seconds_ + measurements * last_seconds_ > share_ * charged_seconds);
    }
    void spend(double seconds) {
        spent_seconds_ += seconds;
        note(seconds);
    }
    /// A measurement made in any case, on no budget; the next one is expected to take as long.
    void note(double seconds) { last_seconds_ = seconds; }
    /// Measurements to come take so much longer than the last one.
    void expect_more(double seconds) { last_seconds_ += seconds; }
    double spent_seconds() const { return spent_seconds_; }

private:
    double share_;
    double spent_seconds_ = 0.0;
    double last_seconds_ = 0.0;
};

}  // namespace pl
