// What a pressed mouse button means: a click, a look around, or nothing of ours. Decided at the press and kept to the
// release, so that a drag that began on a panel never turns the camera.
#pragma once

#include <cmath>
#include <optional>

#include "core/kernel/base/math.h"

namespace pl {

enum class PointerButton { Left, Right };

class PointerGesture {
public:
    static constexpr float kClickPixels = 4.0f;
    static constexpr double kClickSeconds = 0.25;

    /// A button goes down over the image or over something else. A second button does not interrupt the first.
    void press(PointerButton button, Vec2f position, double seconds, bool over_image) {
        if (active_ || !over_image) return;
        active_ = Press{button, position, seconds, button == PointerButton::Right};
    }

    /// The pointer moves. Returns by how much to turn the camera.
    Vec2f move(Vec2f position, Vec2f delta) {
        if (!active_) return Vec2f{0.0f};
        if (active_->turning) return delta;
        const Vec2f from_press = position - active_->position;
        if (std::fabs(from_press.x) < kClickPixels && std::fabs(from_press.y) < kClickPixels) return Vec2f{0.0f};
        active_->turning = true;
        return from_press;  // what the threshold held back comes with the first step
    }

    /// The button goes up. Returns where it clicked if it was a short left press without movement.
    std::optional<Vec2f> release(PointerButton button, double seconds) {
        if (!active_ || active_->button != button) return std::nullopt;
        const Press press = *active_;
        active_.reset();
        if (press.turning || seconds - press.seconds > kClickSeconds) return std::nullopt;
        return press.position;
    }

    /// The window lost the focus: whatever was held is not any more.
    void cancel() { active_.reset(); }

    bool turning() const { return active_ && active_->turning; }
    /// The right button hides the pointer and catches all its movement.
    bool captured() const { return active_ && active_->button == PointerButton::Right; }

private:
    struct Press {
        PointerButton button;
        Vec2f position;
        double seconds;
        bool turning;
    };
    std::optional<Press> active_;
};

}  // namespace pl
