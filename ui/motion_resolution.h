// How coarse the picture becomes while the camera moves, so that it keeps up with the hand.
#pragma once

namespace pl {

/// Divider of width and height, one of 1, 2, 4, 8. Aims at a pass time; changes only outside a dead band, so that it
/// does not flicker between two sizes.
class MotionResolution {
public:
    static constexpr double kTargetSeconds = 1.0 / 30.0;
    static constexpr double kDeadBand = 0.2;
    static constexpr int kMaxDivider = 8;
    static constexpr int kMinLongSide = 128;

    int divider() const { return divider_; }

    /// A pass took this long at this divider. At rest (divider 1) it sets where the next motion starts.
    void observe(int divider, double seconds);

    /// Start over, for a scene or method whose cost is unknown.
    void reset() { divider_ = 4; }

    /// The divider, as far as the image is large enough for it.
    int divider_for(int width, int height) const;

private:
    int divider_ = 4;
};

/// Width or height after division; at least 1.
constexpr int divided(int size, int divider) { return size / divider > 0 ? size / divider : 1; }

}  // namespace pl
