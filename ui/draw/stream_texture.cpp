#include "ui/draw/stream_texture.h"

#include <string>

#include <SDL.h>

#include "core/base/error.h"

namespace pl {
namespace {

SDL_Rect to_sdl(const Rect& rect) {
    return {static_cast<int>(rect.x), static_cast<int>(rect.y), static_cast<int>(rect.width),
            static_cast<int>(rect.height)};
}

}  // namespace

StreamTexture::~StreamTexture() {
    if (texture_ != nullptr) SDL_DestroyTexture(texture_);
}

bool StreamTexture::resize(int width, int height) {
    if (texture_ != nullptr && width == width_ && height == height_) return false;
    if (texture_ != nullptr) SDL_DestroyTexture(texture_);
    // The window's own format: others are converted pixel by pixel.
    texture_ = SDL_CreateTexture(renderer_, SDL_PIXELFORMAT_ARGB8888, SDL_TEXTUREACCESS_STREAMING, width, height);
    if (texture_ == nullptr)
        throw Error(ErrorKind::Runtime, std::string("cannot show the picture: ") + SDL_GetError());
    SDL_SetTextureBlendMode(texture_, SDL_BLENDMODE_NONE);
    width_ = width;
    height_ = height;
    return true;
}

void StreamTexture::fill(const std::function<void(std::uint32_t* out, std::size_t pitch)>& write) {
    void* pixels = nullptr;
    int pitch_bytes = 0;
    if (SDL_LockTexture(texture_, nullptr, &pixels, &pitch_bytes) != 0) return;
    write(static_cast<std::uint32_t*>(pixels), static_cast<std::size_t>(pitch_bytes) / sizeof(std::uint32_t));
    SDL_UnlockTexture(texture_);
}

void StreamTexture::draw(const Rect& target, const Rect& clip) {
    if (texture_ == nullptr) return;
    const SDL_Rect place = to_sdl(target);
    const SDL_Rect part = to_sdl(clip);
    const bool exact = place.w == width_ && place.h == height_;
    SDL_SetTextureScaleMode(texture_, exact ? SDL_ScaleModeNearest : SDL_ScaleModeLinear);
    SDL_RenderSetClipRect(renderer_, &part);
    SDL_RenderCopy(renderer_, texture_, nullptr, &place);
    SDL_RenderSetClipRect(renderer_, nullptr);
}

}  // namespace pl
