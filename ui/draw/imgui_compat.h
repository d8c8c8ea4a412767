// Dear ImGui 1.86 to 1.92 behind one set of names.
#pragma once

#include <imgui.h>

#if __has_include(<backends/imgui_impl_sdl2.h>)
#include <backends/imgui_impl_sdl2.h>
#else
#include <backends/imgui_impl_sdl.h>
#endif

#include <cstdint>

struct SDL_Renderer;
struct SDL_Texture;

namespace pl::ui {

/// From this version on, ImGui takes pointer and buttons from events; before, its platform code polls them.
inline constexpr bool kImGuiHasEventQueue = IMGUI_VERSION_NUM >= 18700;

inline bool init_imgui_platform(SDL_Window* window, [[maybe_unused]] SDL_Renderer* renderer) {
#if IMGUI_VERSION_NUM >= 18700
    return ImGui_ImplSDL2_InitForSDLRenderer(window, renderer);
#else
    return ImGui_ImplSDL2_InitForSDLRenderer(window);
#endif
}

/// ImTextureID is a pointer up to 1.91.3 and an integer from 1.91.4.
inline ImTextureID to_texture_id(SDL_Texture* texture) {
    return (ImTextureID)(std::intptr_t)texture;  // a C cast converts to both
}
inline SDL_Texture* from_texture_id(ImTextureID id) { return (SDL_Texture*)(std::intptr_t)id; }

}  // namespace pl::ui
