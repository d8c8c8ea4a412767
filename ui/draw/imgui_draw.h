// Draws Dear ImGui's output with SDL_Renderer. ImGui's own backend is missing from the libraries of some distributions
// and changed its name twice; this one works with all versions.
#pragma once

struct ImDrawData;
struct SDL_Renderer;
struct SDL_Texture;

namespace pl::ui {

class ImGuiDraw {
public:
    explicit ImGuiDraw(SDL_Renderer* renderer) : renderer_(renderer) {}
    ~ImGuiDraw();
    ImGuiDraw(const ImGuiDraw&) = delete;
    ImGuiDraw& operator=(const ImGuiDraw&) = delete;

    /// After fonts were added to the atlas.
    void upload_fonts();
    void draw(const ImDrawData& data);

private:
    SDL_Renderer* renderer_;
    SDL_Texture* fonts_ = nullptr;
};

}  // namespace pl::ui
