// A picture that is filled pixel by pixel now and then, and drawn into the window every frame.
#pragma once

#include <cstdint>
#include <functional>

#include "ui/overlays/draw_list.h"

struct SDL_Renderer;
struct SDL_Texture;

namespace pl {

class StreamTexture {
public:
    explicit StreamTexture(SDL_Renderer* renderer) : renderer_(renderer) {}
    ~StreamTexture();
    StreamTexture(const StreamTexture&) = delete;
    StreamTexture& operator=(const StreamTexture&) = delete;

    /// Makes it exist with this size; true if what it held is gone. Throws Error(Runtime) if it cannot be made.
    bool resize(int width, int height);
    /// Calls `write` with ARGB8888 pixels and the length of a row in pixels. Not called if the texture cannot be locked.
    void fill(const std::function<void(std::uint32_t* out, std::size_t pitch)>& write);
    /// Fills `target`, of which only what lies in `clip` is drawn. Nothing before the first resize().
    void draw(const Rect& target, const Rect& clip);

private:
    SDL_Renderer* renderer_;
    SDL_Texture* texture_ = nullptr;
    int width_ = 0;
    int height_ = 0;
};

}  // namespace pl
