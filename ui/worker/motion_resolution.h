// The divider of the picture's size while the camera moves, which keeps up the frame rate.
#pragma once

namespace pl::ui {

/// Divider of width and height, one of 1, 2, 4, 8. Aims at a pass time. Changes outside a dead band only, so that the size does
/// not flicker.
class MotionResolution {
public:
    static constexpr double kTargetSeconds = 1.0 / 30.0;
    static constexpr double kDeadBand = 0.2;
    static constexpr int kMaxDivider = 8;
    static constexpr int kMinLongSide = 128;

    int divider() const { return divider_; }

    /// A pass took this long at this divider. Passes at rest (divider 1) set the divider that the next motion begins with.
    void observe(int divider, double seconds);

    /// The cost of a pass is unknown again.
    void reset() { divider_ = 4; }

    /// The divider, or a smaller one for images whose long side would fall below kMinLongSide.
    int divider_for(int width, int height) const;

private:
    int divider_ = 4;
};

/// Width or height after division; at least 1.
constexpr int divided(int size, int divider) { return size / divider > 0 ? size / divider : 1; }

}  // namespace pl::ui
