// Keeps measuring a small share of what is measured.
#pragma once

namespace pl {

/// Seconds spent on measuring, held against the seconds that were charged to what was measured.
class MeasureBudget {
public:
    static constexpr double kDefaultShare = 0.01;

    /// An infinite share allows everything.
    explicit MeasureBudget(double share = kDefaultShare) : share_(share) {}

    /// Whether so many more measurements, each as long as the last one, would leave the whole within the share.
    bool allows(double charged_seconds, int measurements = 1) const {
        return !(spent_seconds_ + measurements * last_seconds_ > share_ * charged_seconds);
    }
    void spend(double seconds) {
        spent_seconds_ += seconds;
        last_seconds_ = seconds;
    }
    /// What the first measurement may take; of no concern once there was one.
    void guess(double seconds) {
        if (spent_seconds_ == 0.0) last_seconds_ = seconds;
    }
    /// From now on a measurement takes so much longer than the last one.
    void expect_more(double seconds) { last_seconds_ += seconds; }
    double spent_seconds() const { return spent_seconds_; }

private:
    double share_;
    double spent_seconds_ = 0.0;
    double last_seconds_ = 0.0;
};

}  // namespace pl
