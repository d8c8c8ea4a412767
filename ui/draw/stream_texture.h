// A texture that is refilled when its picture changes, and drawn into the window every frame.
#pragma once

#include <cstdint>
#include <functional>

#include "ui/draw/draw_list.h"

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

}  // namespace pl::ui
