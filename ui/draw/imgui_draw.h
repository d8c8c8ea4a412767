// Draws Dear ImGui's output with SDL_Renderer. ImGui's own backend is missing from the libraries of some distributions
// and changed its name twice; this one works with all versions.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <imgui.h>

#include "ui/draw/layout.h"

#if __has_include(<backends/imgui_impl_sdl2.h>)
#include <backends/imgui_impl_sdl2.h>
#else
#include <backends/imgui_impl_sdl.h>
#endif

struct SDL_Renderer;
struct SDL_Texture;

namespace pl::ui {

// Dear ImGui 1.86 to 1.92 behind one set of names.

/// From this version on, ImGui takes pointer and buttons from events; before, its platform code polls them.
inline constexpr bool kImGuiHasEventQueue = IMGUI_VERSION_NUM >= 18700;

inline bool init_imgui_platform(SDL_Window* window, [[maybe_unused]] SDL_Renderer* renderer) {
#if IMGUI_VERSION_NUM >= 18700
    return ImGui_ImplSDL2_InitForSDLRenderer(window, renderer);
#else
    return ImGui_ImplSDL2_InitForSDLRenderer(window);
#endif
}

/// A bordered part of a window into and out of which arrow keys move.
inline bool begin_part(const char* id, const ImVec2& size) {
#if IMGUI_VERSION_NUM >= 19090
    return ImGui::BeginChild(id, size, ImGuiChildFlags_Borders | ImGuiChildFlags_NavFlattened);
#else
    return ImGui::BeginChild(id, size, true, ImGuiWindowFlags_NavFlattened);
#endif
}

/// ImTextureID is a pointer up to 1.91.3 and an integer from 1.91.4.
inline ImTextureID to_texture_id(SDL_Texture* texture) {
    return (ImTextureID)(std::intptr_t)texture;  // a C cast converts to both
}
inline SDL_Texture* from_texture_id(ImTextureID id) { return (SDL_Texture*)(std::intptr_t)id; }

// State that the controls of a window share from frame to frame; io.UserData points to it.

class PictureTextures;

struct GuiMemory {
    PictureTextures* textures = nullptr;  ///< of the window's renderer
    std::uint64_t textures_made = 0;      ///< for pictures: a new one may have the address of one that is gone
    int keyed_panel = -1;                 ///< the panel that was given the keyboard in the last frame; -1: none
    float pointer_rest_seconds = 0.0f;    ///< since the pointer moved: tooltips wait for rest
    float top_card_end = 0.0f;  ///< lower edge of the card over the picture's top in the last frame; 0 without one
    float low_card_start =
        std::numeric_limits<float>::infinity();  ///< upper edge of the one over its bottom; infinite without one
    float low_card_height = 0.0f;                ///< of the last such card: cards follow their text
    std::string badges{};                        ///< over the picture in the last frame, for scripts
    /// Rectangles of the controls in the last frame by their labels: scripts point at them.
    std::map<std::string, Rect, std::less<>> places;
    std::string cut{};    ///< controls of the last frame that reach beyond the right edge of their panel
    std::string moved{};  ///< controls that have left the place they had when a script asked them to keep it
};

/// A context of Dear ImGui that keeps no files: the layout follows from the window's size. `memory` outlives it.
void create_gui_context(GuiMemory& memory);

/// Of the present ImGui context.
GuiMemory& gui_memory();

/// A software renderer takes most of the time of a frame, and most panels are as they were: an opaque window that is equal in two frames
/// is drawn into a texture, and copied from then on.
class ImGuiDraw {
public:
    explicit ImGuiDraw(SDL_Renderer* renderer);
    ~ImGuiDraw();
    ImGuiDraw(const ImGuiDraw&) = delete;
    ImGuiDraw& operator=(const ImGuiDraw&) = delete;

    /// After fonts were added to the atlas.
    void upload_fonts();
    void draw(const ImDrawData& data);
    /// Windows that the last draw() has copied.
    std::size_t copied() const { return copied_; }

private:
    /// What a window was made of in the last frame.
    struct KeptWindow {
        std::vector<ImDrawVert> vertices{};
        std::vector<ImDrawIdx> indices{};
        std::vector<ImDrawCmd> commands{};
        SDL_Texture* texture = nullptr;
        bool is_open = false;

        bool equals(const ImDrawList& list) const;
        void take(const ImDrawList& list);
    };

    /// Within `bounds`. `vertices`: of the list, moved so that `origin` is the corner of the target.
    void draw_list(const ImDrawList& list, const ImDrawVert* vertices, const Rect& bounds, ImVec2 origin);
    void draw_window(const ImDrawList& list, const Rect& place);
    SDL_Texture* make_texture(const KeptWindow& window, const ImDrawList& list, const Rect& place);
    void forget_windows();

    SDL_Renderer* renderer_;
    SDL_Texture* fonts_ = nullptr;
    bool keeps_windows_;
    std::uint64_t textures_made_ = 0;                         ///< when the windows were kept
    std::map<std::string, KeptWindow, std::less<>> windows_;  ///< by their names
    std::size_t copied_ = 0;
};

}  // namespace pl::ui
