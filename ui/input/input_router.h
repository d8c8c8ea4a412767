// Distributes input to the panels, the camera and the table of actions.
#pragma once

#include <cmath>
#include <optional>
#include <set>

#include <SDL_events.h>

#include "core/kernel/base/math.h"
#include "ui/draw/layout.h"
#include "ui/input/actions.h"
#include "ui/model/viewer_model.h"

namespace pl::ui {

// The meaning of a pressed mouse button: a click, a look around, or neither. Decided at the press and kept until the
// release, so that a drag that began on a panel never turns the camera.

enum class PointerButton { Left, Right, Middle };

/// The meaning of a drag, decided when it begins.
enum class Drag { Look, Orbit, PanCamera, PanPicture };

class PointerGesture {
public:
    static constexpr float kClickPixels = 4.0f;
    static constexpr double kDoubleClickSeconds = 0.4;  ///< between the clicks of a double click

    /// A button goes down, over the image or not. A second button does not interrupt the first.
    void press(PointerButton button, Vec2f position, bool over_image, Drag drag = Drag::Look) {
        if (active_ || !over_image) return;
        active_ = Press{button, position, button == PointerButton::Right, drag};
    }

    /// Meaning of the drag under way.
    Drag drag() const { return active_ ? active_->drag : Drag::Look; }

    /// The pointer moves. Returns the mouse movement of the drag.
    Vec2f move(Vec2f position, Vec2f delta) {
        if (!active_) return Vec2f{0.0f};
        if (active_->turning) return delta;
        const Vec2f from_press = position - active_->position;
        if (std::fabs(from_press.x) < kClickPixels && std::fabs(from_press.y) < kClickPixels) return Vec2f{0.0f};
        active_->turning = true;
        return from_press;  // includes the pixels below the threshold
    }

    /// The button goes up. Returns the position of a click: a left press without movement, however long it seems to a window that was
    /// busy meanwhile.
    std::optional<Vec2f> release(PointerButton button, double seconds) {
        if (!active_ || active_->button != button) return std::nullopt;
        const Press press = *active_;
        active_.reset();
        if (press.turning || button != PointerButton::Left) return std::nullopt;
        const bool is_near = last_click_ && glm::length(press.position - last_click_->position) < kClickPixels;
        is_double_ = is_near && seconds - last_click_->seconds < kDoubleClickSeconds;
        last_click_ = Click{press.position, seconds};
        return press.position;
    }
    /// Whether the last click followed another one in the same place.
    bool is_double() const { return is_double_; }

    /// The window lost the focus: no button is held any more.
    void cancel() { active_.reset(); }

    bool turning() const { return active_ && active_->turning; }
    /// The right button hides the pointer and captures its movement.
    bool captured() const { return active_ && active_->button == PointerButton::Right; }

private:
    struct Press {
        PointerButton button;
        Vec2f position;
        bool turning;
        Drag drag;
    };
    struct Click {
        Vec2f position;
        double seconds;
    };
    std::optional<Press> active_;
    std::optional<Click> last_click_;
    bool is_double_ = false;
};

class InputRouter {
public:
    explicit InputRouter(SDL_Window* window) : window_(window) {}

    /// `image` is the rectangle of the picture, `panels_want_pointer` whether Dear ImGui claims the pointer, `panels_want_text` whether
    /// a text field or a dialog has the keyboard.
    struct Context {
        Rect image;
        Rect view;
        bool panels_want_pointer = false;
        bool panels_want_text = false;
        double seconds = 0.0;
    };
    void handle(const SDL_Event& event, ViewerModel& model, const Context& context);

    /// The motion of the held keys.
    MoveKeys move_keys() const;

    /// Whether the key of a held action is down.
    bool is_held(ActionId action) const { return held_.contains(action); }

    /// The last position of the pointer.
    Vec2f pointer() const { return pointer_; }

    /// Keys or buttons of the camera are held: the window is redrawn without further events.
    bool active() const { return !held_.empty() || gesture_.turning(); }

private:
    void key_down(const SDL_KeyboardEvent& event, ViewerModel& model, const Context& context);
    void key_up(const SDL_KeyboardEvent& event);
    void button(const SDL_MouseButtonEvent& event, ViewerModel& model, const Context& context);
    void click(Vec2f position, ViewerModel& model, const Context& context) const;
    void motion(const SDL_MouseMotionEvent& event, ViewerModel& model, const Context& context);
    void wheel(int notches, ViewerModel& model, const Context& context) const;
    void let_go();

    SDL_Window* window_;
    PointerGesture gesture_;
    std::set<ActionId> held_;
    Vec2f pointer_{-1.0f};
    bool skip_next_motion_ = false;  ///< the first one after the focus returned is a jump
};

}  // namespace pl::ui
