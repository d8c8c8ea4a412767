// A texture that is refilled when its picture changes, and drawn into the window every frame.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>

#include "core/io/image.h"
#include "ui/draw/draw_list.h"
#include "ui/draw/imgui_draw.h"
#include "ui/draw/lobes.h"

struct SDL_Renderer;
struct SDL_Texture;

namespace pl::ui {

/// The look of a texture that is drawn larger than it is.
enum class Scaling {
    Smooth,   ///< interpolated
    Nearest,  ///< each pixel is a square
};

class StreamTexture {
public:
    explicit StreamTexture(SDL_Renderer* renderer) : renderer_(renderer) {}
    ~StreamTexture();
    StreamTexture(const StreamTexture&) = delete;
    StreamTexture& operator=(const StreamTexture&) = delete;

    /// Gives it this size; true if its pixels were lost. Throws Error(Runtime) if it cannot be created.
    bool resize(int width, int height);
    /// Calls `write` with ARGB8888 pixels and the length of a row in pixels, unless the texture cannot be locked.
    void fill(const std::function<void(std::uint32_t* out, std::size_t pitch)>& write);
    /// Draws it over `target`, clipped to `clip`. Nothing before the first resize().
    void draw(const Rect& target, const Rect& clip, Scaling scaling = Scaling::Smooth);

private:
    void draw_slices(const Rect& target, const Rect& clip);

    SDL_Renderer* renderer_;
    SDL_Texture* texture_ = nullptr;
    int width_ = 0;
    int height_ = 0;
};

/// Small pictures and large meshes as textures of the window's renderer, for Dear ImGui; each is uploaded or drawn once.
class PictureTextures {
public:
    explicit PictureTextures(SDL_Renderer* renderer) : renderer_(renderer) {}
    ~PictureTextures();
    PictureTextures(const PictureTextures&) = delete;
    PictureTextures& operator=(const PictureTextures&) = delete;

    /// The picture must not change. Null if the renderer has no room.
    SDL_Texture* of(const std::shared_ptr<const ByteImage>& picture);
    /// The part of a mesh of opaque triangles in a rectangle of the window: without a graphics card its triangles take most of the time
    /// of a frame. The last two are kept. Null if the renderer cannot draw into textures.
    SDL_Texture* of(const std::shared_ptr<const ScreenMesh>& mesh, const Rect& part);
    /// Those of pictures that nobody else has any more. Between frames, whose lists name textures.
    void drop_unused();

private:
    struct MeshTexture {
        std::shared_ptr<const ScreenMesh> mesh{};
        Rect part{};
        SDL_Texture* texture = nullptr;
    };
    SDL_Texture* draw(const ScreenMesh& mesh, const Rect& part);

    SDL_Renderer* renderer_;
    std::map<std::shared_ptr<const ByteImage>, SDL_Texture*> textures_;
    std::array<MeshTexture, 2> meshes_{};  ///< the newest first: compared pictures have a place each
};

/// PictureTextures::of() of the window's renderer; null without a window, too.
template <class... Parts>
SDL_Texture* texture_of(const Parts&... parts) {
    PictureTextures* const textures = gui_memory().textures;
    return textures != nullptr ? textures->of(parts...) : nullptr;
}

}  // namespace pl::ui
