#include "ui/draw/picture_textures.h"

#include <SDL.h>

namespace pl::ui {

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
