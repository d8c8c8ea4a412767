// The window's icon, drawn by the program.
#pragma once

struct SDL_Window;

namespace pl::ui {

void set_window_icon(SDL_Window* window);

}  // namespace pl::ui
