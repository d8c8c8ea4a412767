#include "ui/input/input_router.h"

#include <SDL.h>

#include "ui/input/perform_action.h"

namespace pl::ui {
namespace {

constexpr float kFastFactor = 4.0f;
constexpr float kSlowFactor = 0.25f;

KeyStroke stroke_of(const SDL_KeyboardEvent& event) {
    const Uint16 mod = event.keysym.mod;
    return {event.keysym.scancode,
            event.keysym.sym,
            {.shift = (mod & KMOD_SHIFT) != 0, .ctrl = (mod & KMOD_CTRL) != 0, .alt = (mod & KMOD_ALT) != 0}};
}

std::optional<PointerButton> button_of(int button) {
    switch (button) {
    case SDL_BUTTON_LEFT: return PointerButton::Left;
    case SDL_BUTTON_RIGHT: return PointerButton::Right;
    case SDL_BUTTON_MIDDLE: return PointerButton::Middle;
    default: return std::nullopt;
    }
}

/// The meaning of a drag with the keys that are down now.
Drag drag_of(PointerButton button) {
    if (button == PointerButton::Right) return Drag::Look;
    const SDL_Keymod mod = SDL_GetModState();
    if ((mod & KMOD_CTRL) != 0) return Drag::PanPicture;
    if ((mod & KMOD_SHIFT) != 0) return Drag::PanCamera;
    return (mod & KMOD_ALT) != 0 || button == PointerButton::Middle ? Drag::Orbit : Drag::Look;
}

/// Actions that repeat while the key is held down.
bool repeats(ActionId action) {
    switch (action) {
    case ActionId::SpeedUp:
    case ActionId::SpeedDown:
    case ActionId::ExposureDown:
    case ActionId::ExposureUp:
    case ActionId::CellsFainter:
    case ActionId::CellsStronger:
    case ActionId::SinglePass: return true;
    default: return false;
    }
}

}  // namespace

void InputRouter::handle(const SDL_Event& event, ViewerModel& model, const Context& context) {
    switch (event.type) {
    case SDL_KEYDOWN: key_down(event.key, model, context); break;
    case SDL_KEYUP: key_up(event.key); break;
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP: button(event.button, model, context); break;
    case SDL_MOUSEMOTION: motion(event.motion, model, context); break;
    case SDL_MOUSEWHEEL: wheel(event.wheel.y, model, context); break;
    case SDL_DROPFILE:
        model.files().open(event.drop.file);
        SDL_free(event.drop.file);
        break;
    case SDL_WINDOWEVENT:
        if (event.window.event == SDL_WINDOWEVENT_FOCUS_LOST) let_go();
        if (event.window.event == SDL_WINDOWEVENT_FOCUS_GAINED) skip_next_motion_ = true;
        if (event.window.event == SDL_WINDOWEVENT_CLOSE) model.window().requests.quit = true;
        break;
    case SDL_QUIT: model.window().requests.quit = true; break;
    default: break;
    }
}

void InputRouter::key_down(const SDL_KeyboardEvent& event, ViewerModel& model, const Context& context) {
    if (context.panels_want_text) return;
    const Action* action = find_action(stroke_of(event));
    if (action == nullptr) return;
    if (action->is_held)
        held_.insert(action->id);
    else if (event.repeat == 0 || repeats(action->id))
        perform(model, *action);
}

void InputRouter::key_up(const SDL_KeyboardEvent& event) {
    // Without modifiers: they may have changed since the key went down.
    KeyStroke stroke = stroke_of(event);
    stroke.modifiers = {};
    for (const Action& action : all_actions())
        if (action.is_held && matches(action, stroke)) held_.erase(action.id);
}

void InputRouter::button(const SDL_MouseButtonEvent& event, ViewerModel& model, const Context& context) {
    const auto which = button_of(event.button);
    if (!which) return;
    const Vec2f position{static_cast<float>(event.x), static_cast<float>(event.y)};
    const bool was_captured = gesture_.captured();
    if (event.type == SDL_MOUSEBUTTONDOWN) {
        pointer_ = position;
        gesture_.press(*which, position, context.view.contains(position) && !context.panels_want_pointer,
                       drag_of(*which));
    } else if (const auto clicked = gesture_.release(*which, context.seconds)) {
        click(*clicked, model, context);
    }
    if (gesture_.captured() != was_captured) SDL_SetRelativeMouseMode(gesture_.captured() ? SDL_TRUE : SDL_FALSE);
    // A drag continues outside the window.
    if (!gesture_.captured()) SDL_CaptureMouse(event.type == SDL_MOUSEBUTTONDOWN ? SDL_TRUE : SDL_FALSE);
}

void InputRouter::click(Vec2f position, ViewerModel& model, const Context& context) const {
    if (gesture_.is_double() && !model.window().zoom.is_whole()) return model.window().zoom.reset();
    if (!context.image.contains(position)) return;
    const Vec2f point = picture_point(context.image, position);
    model.selection().pick(point);
    model.paths().pick(point);
}

void InputRouter::wheel(int notches, ViewerModel& model, const Context& context) const {
    if (!context.view.contains(pointer_) || context.panels_want_pointer) return;
    if ((SDL_GetModState() & KMOD_CTRL) == 0) return model.camera().change_speed(static_cast<float>(notches));
    const RenderSettings settings = model.render().settings();
    model.window().zoom.step(notches, pointer_, context.view, settings.width, settings.height);
}

void InputRouter::motion(const SDL_MouseMotionEvent& event, ViewerModel& model, const Context& context) {
    if (!gesture_.captured()) pointer_ = {static_cast<float>(event.x), static_cast<float>(event.y)};
    if (skip_next_motion_) {
        skip_next_motion_ = false;
        return;
    }
    const Vec2f turn = gesture_.move({static_cast<float>(event.x), static_cast<float>(event.y)},
                                     {static_cast<float>(event.xrel), static_cast<float>(event.yrel)});
    switch (gesture_.drag()) {
    case Drag::Look: model.camera().look(turn); break;
    case Drag::Orbit: model.camera().orbit(turn, model.orbit_center()); break;
    case Drag::PanCamera: {
        const float height = context.image.height > 0.0f ? context.image.height : context.view.height;
        model.camera().pan(turn, model.orbit_center(), height);
        break;
    }
    case Drag::PanPicture: {
        const RenderSettings settings = model.render().settings();
        model.window().zoom.pan(turn, settings.width, settings.height);
        break;
    }
    }
}

void InputRouter::let_go() {
    held_.clear();
    if (gesture_.captured()) SDL_SetRelativeMouseMode(SDL_FALSE);
    gesture_.cancel();
}

MoveKeys InputRouter::move_keys() const {
    const auto held = [&](ActionId action) { return held_.count(action) > 0 ? 1.0f : 0.0f; };
    MoveKeys keys;
    keys.forward = held(ActionId::MoveForward) - held(ActionId::MoveBack);
    keys.right = held(ActionId::MoveRight) - held(ActionId::MoveLeft);
    keys.up = held(ActionId::MoveUp) - held(ActionId::MoveDown);
    if (held_.count(ActionId::Fast) > 0) keys.speed_factor *= kFastFactor;
    if (held_.count(ActionId::Slow) > 0) keys.speed_factor *= kSlowFactor;
    return keys;
}

}  // namespace pl::ui
