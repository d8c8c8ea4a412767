#include "ui/draw/stream_texture.h"

#include <cmath>
#include <string>

#include <SDL.h>

#include "core/base/error.h"
#include "ui/draw/picture_zoom.h"

namespace pl::ui {
namespace {

SDL_Rect to_sdl(const Rect& rect) {
    // By its edges, so that neighbors meet.
    const auto pixel = [](float at) { return static_cast<int>(std::lround(at)); };
    const int x = pixel(rect.x);
    const int y = pixel(rect.y);
    return {x, y, pixel(rect.x + rect.width) - x, pixel(rect.y + rect.height) - y};
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

void StreamTexture::draw(const Rect& target, const Rect& clip, Scaling scaling) {
    if (texture_ == nullptr) return;
    if (scaling == Scaling::Nearest && target.width > static_cast<float>(width_)) return draw_slices(target, clip);
    const SDL_Rect place = to_sdl(target);
    const SDL_Rect part = to_sdl(clip);
    const bool exact = place.w == width_ && place.h == height_;
    SDL_SetTextureScaleMode(texture_, exact ? SDL_ScaleModeNearest : SDL_ScaleModeLinear);
    SDL_RenderSetClipRect(renderer_, &part);
    SDL_RenderCopy(renderer_, texture_, nullptr, &place);
    SDL_RenderSetClipRect(renderer_, nullptr);
}

/// The renderer cuts a large target at whole pixels of the texture, and would show them too wide or too narrow.
void StreamTexture::draw_slices(const Rect& target, const Rect& clip) {
    SDL_SetTextureScaleMode(texture_, SDL_ScaleModeNearest);
    for (const PictureSlice& slice : visible_slices(target, clip, width_, height_)) {
        const SDL_Rect from{slice.x, slice.y, slice.width, slice.height};
        const SDL_Rect to = to_sdl(slice.place);
        if (to.w > 0 && to.h > 0) SDL_RenderCopy(renderer_, texture_, &from, &to);
    }
}

PictureTextures::~PictureTextures() {
    for (const auto& [picture, texture] : textures_)
        if (texture != nullptr) SDL_DestroyTexture(texture);
}

SDL_Texture* PictureTextures::of(const std::shared_ptr<const ByteImage>& picture) {
    const auto [entry, is_new] = textures_.try_emplace(picture, nullptr);
    if (!is_new) return entry->second;
    SDL_Texture* const texture = SDL_CreateTexture(renderer_, SDL_PIXELFORMAT_RGB24, SDL_TEXTUREACCESS_STATIC,
                                                   picture->width, picture->height);
    if (texture != nullptr) {
        SDL_UpdateTexture(texture, nullptr, picture->rgb.data(), picture->width * 3);
        SDL_SetTextureScaleMode(texture, SDL_ScaleModeLinear);
    }
    return entry->second = texture;
}

}  // namespace pl::ui
