// Distributes input to the panels, the camera and the table of actions.
#pragma once

#include <set>

#include <SDL_events.h>

#include "ui/draw/layout.h"
#include "ui/input/actions.h"
#include "ui/input/pointer_gesture.h"
#include "ui/model/viewer_model.h"

namespace pl::ui {

class InputRouter {
public:
    explicit InputRouter(SDL_Window* window) : window_(window) {}

    /// `image` is the rectangle of the picture, `panels_want_*` whether Dear ImGui claims the pointer or the keyboard.
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
